//! State that goes on until the board ends it, and its end if the board no longer can.

use super::event::Event;
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::Micros;
use taxel_core::react::Reaction;
use taxel_core::surface::RegionPhase;
use taxel_core::symbol::Symbol;
use taxel_core::wire::{LISTED, PressingReport, ReactionReport, RegionsReport, SymbolList};

/// Ongoing state, besides contacts and intention.
#[derive(Debug, Default, Clone)]
pub(super) struct Ongoing {
    /// Words of the contacts that are present, as they were reported last.
    symbols: Vec<Symbol>,
    /// Regions of the robot's surface, if any of them is not free.
    regions: Option<RegionsReport>,
    /// Something presses on the robot.
    presses: bool,
    reactions: Vec<Reaction>,
    /// Contacts that the host has ended, and those whose words it has: if the board still knows them, they begin anew.
    ended: [Vec<u32>; 2],
}

impl Ongoing {
    /// Takes symbols. A contact that the host has ended begins anew.
    pub fn symbols(&mut self, list: &mut SymbolList) {
        for symbol in &mut list.events {
            if let Some(at) = self.ended[1].iter().position(|id| *id == symbol.contact) {
                self.ended[1].swap_remove(at);
                symbol.phase = if symbol.phase == Phase::Held { Phase::Onset } else { symbol.phase };
            }
            self.symbols.retain(|known| known.contact != symbol.contact);
            if symbol.phase != Phase::Released {
                self.symbols.push(*symbol);
            }
        }
    }

    /// Takes present contacts. Those that the host has ended begin anew.
    pub fn contacts(&mut self, present: &mut [Placed]) {
        let ended = std::mem::take(&mut self.ended[0]);
        let held = present.iter_mut().filter(|placed| placed.contact.phase == Phase::Held);
        held.filter(|placed| ended.contains(&placed.contact.id))
            .for_each(|placed| placed.contact.phase = Phase::Onset);
    }

    /// Takes the state of the robot's surface.
    pub fn regions(&mut self, report: &RegionsReport) {
        let is_touched = report.regions.iter().any(|region| region.phase != RegionPhase::Free);
        self.regions = is_touched.then(|| report.clone());
    }

    /// Takes what presses on the robot.
    pub fn pressing(&mut self, report: &PressingReport) {
        self.presses = !report.contacts.is_empty() || !report.links.is_empty();
    }

    /// Takes the begin or end of a reaction.
    pub fn reaction(&mut self, reaction: &Reaction) {
        self.reactions.retain(|known| known.index != reaction.index);
        if reaction.active {
            self.reactions.push(reaction.clone());
        }
    }

    /// Ends everything, with the contacts of these ids. Returns the events that say so.
    pub fn end(&mut self, contacts: Vec<u32>, frame: u32, time: Micros) -> Vec<Event> {
        let mut events = Vec::new();
        let Ongoing { symbols, regions, presses, reactions, .. } = std::mem::take(self);
        self.ended[0] = contacts;
        self.ended[1] = symbols.iter().map(|symbol| symbol.contact).collect();
        if !symbols.is_empty() {
            let ends = symbols.into_iter().take(LISTED).map(|it| Symbol { phase: Phase::Released, ..it });
            let list = SymbolList { frame, time, events: ends.collect(), regions: Default::default() };
            events.push(Event::Symbols(Box::new(list)));
        }
        if let Some(mut report) = regions {
            (report.frame, report.time) = (frame, time);
            for region in &mut report.regions {
                let is_touched = !matches!(region.phase, RegionPhase::Free | RegionPhase::Released);
                region.phase = if is_touched { RegionPhase::Released } else { RegionPhase::Free };
                (region.contacts, region.since) = (0, time);
            }
            events.push(Event::Regions(Box::new(report)));
        }
        if presses {
            let nothing = PressingReport { frame, time, ..PressingReport::default() };
            events.push(Event::Pressing(Box::new(nothing)));
        }
        let ends = reactions.into_iter().map(|reaction| Reaction { active: false, ..reaction });
        events.extend(ends.map(|reaction| Event::Reaction(ReactionReport { frame, time, reaction })));
        events
    }
}
