//! The stage: words and events of a frame.

use super::config::SymbolConfig;
use super::said::{ReportedWords, said_of};
use super::words::Words;
use crate::body::Placed;
use crate::contact::Phase;
use crate::format::{Invalid, Micros};
use crate::garment::{Layout, PANELS};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Event: the words of a contact at its onset, at a change, or at its release.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Symbol {
    /// Id of the contact.
    pub contact: u32,
    /// Onset or release; `Held` stands for a change of words.
    pub phase: Phase,
    /// Index into the layout's regions.
    pub region: u8,
    /// The words.
    pub words: Words,
    /// Greatest total so far, counts.
    pub peak_total: u32,
    /// Time since onset, ms.
    pub duration_ms: u32,
}

/// State of one region of the body.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionState {
    /// Index into the layout's regions.
    pub region: u8,
    /// Number of contacts.
    pub contacts: u8,
    /// Sum of their totals, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// True if a contact slides.
    pub moving: bool,
    /// Time since which the region has been touched, or untouched.
    pub since: Micros,
}

/// State of the stage, for at most CONTACTS contacts (32 or fewer).
#[derive(Debug, Clone)]
pub struct SymbolState<const CONTACTS: usize> {
    /// Words of the present contacts.
    said: Vec<ReportedWords, CONTACTS>,
    /// Last words of the contacts released in the last frame, in their order.
    last_words: Vec<Words, CONTACTS>,
    /// Contacts of the last frame whose onset is an event, one bit each, in their order.
    onsets: u32,
    /// Contacts of the last frame whose change of words is an event.
    changes: u32,
    /// Time of the last frame.
    last: Micros,
    regions: [RegionState; PANELS],
}

impl<const CONTACTS: usize> Default for SymbolState<CONTACTS> {
    fn default() -> Self {
        const { assert!(CONTACTS <= 32, "one bit each") };
        SymbolState {
            said: Vec::new(),
            last_words: Vec::new(),
            onsets: 0,
            changes: 0,
            last: Micros(0),
            regions: [RegionState::default(); PANELS],
        }
    }
}

impl<const CONTACTS: usize> SymbolState<CONTACTS> {
    /// True if the last frame has events.
    pub fn has_events(&self) -> bool {
        self.onsets | self.changes != 0 || !self.last_words.is_empty()
    }

    /// Events of the last frame, in which contacts were `present` and `released`: at most one for each. They
    /// are made when they are read, since a frame in which all contacts end and as many begin has 64.
    pub fn events<'a>(
        &'a self,
        present: &'a [Placed],
        released: &'a [Placed],
    ) -> impl Iterator<Item = Symbol> + 'a {
        let news = present.iter().enumerate().filter_map(|(index, placed)| {
            let is_in = |set: u32| set >> (index & 31) & 1 == 1;
            let phase = if is_in(self.onsets) { Phase::Onset } else { Phase::Held };
            let id = Some(placed.contact.id).filter(|_| is_in(self.onsets | self.changes))?;
            let said = self.said.iter().find(|said| said.contact == id)?;
            Some(symbol(placed, phase, said.words))
        });
        let ends = released.iter().zip(&self.last_words);
        news.chain(ends.map(|(placed, words)| symbol(placed, Phase::Released, *words)))
    }

    /// Forgets all contacts: their words become the last ones, of contacts that were released.
    pub(crate) fn reset(&mut self) {
        self.last_words.clear();
        for said in &self.said {
            // Always room: as many places as contacts.
            let _ = self.last_words.push(said.words);
        }
        self.said.clear();
        (self.onsets, self.changes) = (0, 0);
        self.regions = [RegionState::default(); PANELS];
    }

    /// Resets the classes of all contacts, because another base of shapes is in force that does not have
    /// their names.
    pub(crate) fn forget_classes(&mut self) {
        self.said.iter_mut().for_each(ReportedWords::forget_class);
    }

    /// Words of a present contact.
    pub(crate) fn words(&self, contact: u32) -> Option<Words> {
        Some(self.said.iter().find(|said| said.contact == contact)?.words)
    }

    /// State of the first `count` regions.
    pub fn regions(&self, count: usize) -> &[RegionState] {
        self.regions.get(..count).unwrap_or(&self.regions)
    }
}

/// Greatest time since the last frame that counts as evidence, ms.
const MOST_MS: u32 = 100;

/// The checked stage.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Symbols {
    config: SymbolConfig,
}

impl SymbolConfig {
    /// Checks the limits. Error if a list does not ascend.
    pub fn build(&self) -> Result<Symbols, Invalid> {
        let must = "must rise";
        if !self.strength.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.strength", must });
        }
        if !self.extent.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.extent", must });
        }
        if !self.span_ms.is_sorted_by(|a, b| a < b) {
            return Err(Invalid { parameter: "symbol.span_ms", must });
        }
        Ok(Symbols { config: *self })
    }
}

impl Symbols {
    /// Processes the contacts of the frame of time `now`: those `present`, then those `released`.
    pub fn process<const CONTACTS: usize>(
        &self,
        state: &mut SymbolState<CONTACTS>,
        layout: &Layout,
        present: &[Placed],
        released: &[Placed],
        now: Micros,
    ) {
        let ms = now.millis_since(state.last);
        // The rest of a millisecond counts with the next frame.
        state.last = if ms > MOST_MS { now } else { Micros(state.last.0 + u64::from(ms) * 1000) };
        let ms = ms.min(MOST_MS) as u8;
        // First, which makes room for those that begin.
        self.release(state, layout, released);
        (state.onsets, state.changes) = (0, 0);
        let (mut at, mut bit) = (0, 1);
        for placed in present {
            let area = area_mm2(layout, placed);
            match said_of(&mut state.said, &mut at, placed.contact.id) {
                Some(said) => {
                    if said.follow(&self.config, placed, area, ms) {
                        state.changes |= bit;
                    }
                }
                None => {
                    // Always room: as many places as contacts.
                    let _ = state.said.push(ReportedWords::new(&self.config, placed, area));
                    state.onsets |= bit;
                }
            }
            bit <<= 1;
        }
        regions(&mut state.regions, present, now);
    }

    /// Keeps the last words of the contacts that are `released`, and forgets the rest of them.
    fn release<const CONTACTS: usize>(
        &self,
        state: &mut SymbolState<CONTACTS>,
        layout: &Layout,
        released: &[Placed],
    ) {
        state.last_words.clear();
        if released.is_empty() {
            return;
        }
        for placed in released {
            let last = state.said.iter().find(|said| said.contact == placed.contact.id);
            let words = last.map_or_else(
                || ReportedWords::new(&self.config, placed, area_mm2(layout, placed)).words,
                |said| said.words,
            );
            // Always room: as many places as contacts.
            let _ = state.last_words.push(words);
        }
        state.said.retain(|said| released.iter().all(|gone| gone.contact.id != said.contact));
    }
}

#[inline(always)] // has two callers
fn area_mm2(layout: &Layout, placed: &Placed) -> u32 {
    let area = layout.areas().get(usize::from(placed.contact.panel));
    // 16 bits each: no taxel is a quarter of a metre wide.
    u32::from(placed.contact.area) * area.map_or(0, |area| area.cell_mm2.min(0xffff))
}

fn symbol(placed: &Placed, phase: Phase, words: Words) -> Symbol {
    Symbol {
        contact: placed.contact.id,
        phase,
        region: placed.region,
        words,
        peak_total: placed.contact.peak_total,
        duration_ms: placed.contact.duration_ms,
    }
}

fn regions(states: &mut [RegionState; PANELS], present: &[Placed], now: Micros) {
    const { assert!(PANELS <= 32) };
    // One bit for each region that was touched.
    let mut touched = 0u32;
    for (region, state) in (0u8..).zip(&mut *states) {
        touched |= u32::from(state.contacts > 0) << region;
        *state = RegionState { region, since: state.since, ..RegionState::default() };
    }
    // One by one: a loop over two at a time would need a division.
    let mut left = present;
    while let [placed, rest @ ..] = left {
        left = rest;
        let Some(state) = states.get_mut(usize::from(placed.region)) else { continue };
        state.contacts = state.contacts.saturating_add(1);
        state.total = state.total.saturating_add(placed.contact.total);
        state.peak = state.peak.max(placed.contact.peak);
        state.moving |= placed.contact.slip;
    }
    for state in states {
        if (touched & 1 == 1) != (state.contacts > 0) {
            state.since = now;
        }
        touched >>= 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_that_do_not_rise_are_refused_by_name() {
        let refused = |edit: fn(&mut SymbolConfig)| {
            let mut config = SymbolConfig::default();
            edit(&mut config);
            config.build().unwrap_err().parameter
        };
        assert_eq!(refused(|c| c.strength[1] = c.strength[0]), "symbol.strength");
        assert_eq!(refused(|c| c.extent = [9, 8]), "symbol.extent");
        assert_eq!(refused(|c| c.span_ms = [800, 150]), "symbol.span_ms");
    }
}
