//! Selects what of a frame is sent.

use super::{Outbox, Streamed};
use crate::body::Placed;
use crate::format::Micros;
use crate::garment::PANELS;
use crate::gesture::Gesture;
use crate::intent::{Leading, Meaning};
use crate::pipeline::{CONTACTS, Percept};
use crate::react::Reaction;
use crate::symbol::{RegionState, SymbolState};
use crate::wire::*;

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Queues what was perceived in a frame. If the frame is `late`, its image, which is costly, is left out,
    /// unless one is already waiting for the link.
    pub fn enqueue(
        &mut self,
        frame: u32,
        time: Micros,
        percept: &Percept<'_>,
        late: bool,
        health: &mut Health,
    ) {
        if !self.streaming {
            return;
        }
        for reaction in percept.reactions.changes() {
            self.reaction(ReactionReport { frame, time, reaction: reaction.clone() }, health);
        }
        if let Some(meaning) = percept.meaning.filter(|_| self.rates.intent) {
            let report = intent_report((frame, time), meaning);
            if meaning.changed {
                health.lost += u32::from(self.changes.push_back(report).is_err());
                self.intent = None;
            } else {
                self.intent = Some(report);
            }
        }
        self.enqueue_gesture(frame, time, percept, health);
        self.enqueue_contacts(frame, time, percept, health);
        self.unsure |= percept.unsure.has_changed();
        self.enqueue_symbols(frame, time, percept, health);
        // A waiting image is encoded from the newest image and codes, so it gets their number.
        let due = self.rates.frames.due(time);
        let waits = self.image.due.is_some();
        health.thinned_frames += u32::from(due && (waits || late));
        if waits || (due && !late) {
            self.image.due = Some((frame, time));
        }
        if cfg!(feature = "raw") && (self.rates.raw.due(time) || self.raw.is_some()) {
            self.raw = Some((frame, time));
        }
    }

    /// Queues a reaction that began or ended without a frame that shows its cause.
    pub fn reaction(&mut self, report: ReactionReport, health: &mut Health) {
        if !self.streaming {
            return;
        }
        if self.reactions.is_full() {
            health.lost += u32::from(self.forget_reaction(&report.reaction));
        }
        health.lost += u32::from(self.reactions.push_back(report).is_err());
    }

    /// Drops the oldest report of a reaction for which a later one, or `next`, is queued, so that the present
    /// state of each is always sent. Returns true if there was one.
    #[cold]
    fn forget_reaction(&mut self, next: &Reaction) -> bool {
        let name =
            |at: usize| self.reactions.iter().nth(at).map_or(&next.name, |report| &report.reaction.name);
        let count = self.reactions.len();
        let Some(old) = (0..count).find(|old| (old + 1..=count).any(|at| name(at) == name(*old))) else {
            return false;
        };
        for at in 0..count {
            let report = self.reactions.pop_front().filter(|_| at != old);
            report.into_iter().for_each(|report| _ = self.reactions.push_back(report));
        }
        true
    }

    /// Queues a reflex, and the reaction it began, unless a frame has shown its cause meanwhile.
    pub fn reflex(&mut self, report: ReflexReport, reaction: Option<Reaction>, health: &mut Health) {
        if !self.streaming {
            return;
        }
        let ReflexReport { frame, time, .. } = report;
        health.lost += u32::from(self.reflexes.push_back(report).is_err());
        if let Some(reaction) = reaction {
            self.reaction(ReactionReport { frame, time, reaction }, health);
        }
    }

    fn enqueue_gesture(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let Some((gesture, name)) = &percept.gesture else { return };
        let Gesture { touch, panel, class, score, lead, confidence, observed_ms, ended } = *gesture;
        let name = name.clone();
        let report =
            GestureReport { frame, time, touch, panel, class, name, score, lead, observed_ms, ended };
        health.lost += u32::from(self.gestures.push_back((report, confidence)).is_err());
    }

    /// Queues the newest state of each contact; onsets and ends stay until they are sent.
    fn enqueue_contacts(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let due = self.rates.contacts.due(time);
        let Percept { present, released, dropped, .. } = *percept;
        self.contacts.take((frame, time), [present, released], due && !present.is_empty(), health);
        self.contacts.dropped = dropped;
        let aged = percept.form_ages.iter().any(|age| *age > 0);
        self.ages_wait = self.tell_ages && self.contacts.waits && aged;
    }

    fn enqueue_symbols(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        if self.rates.symbols && (percept.symbols.has_events() || self.symbols_wait) {
            let Percept { symbols, present, released, .. } = *percept;
            self.list_regions((frame, time), symbols.regions(PANELS));
            self.list_events(symbols, [present, released], health);
        }
    }

    /// Queues the touched ones of these regions.
    fn list_regions(&mut self, (frame, time): (u32, Micros), regions: &[RegionState]) {
        let list = &mut self.symbols;
        if !core::mem::replace(&mut self.symbols_wait, true) {
            list.events.clear();
        }
        list.regions.clear();
        for region in regions.iter().filter(|region| region.contacts > 0) {
            // There are as many places as regions.
            let _ = list.regions.push(*region);
        }
        (list.frame, list.time) = (frame, time);
    }

    /// Adds the events of contacts that are present, and of those that ended.
    fn list_events(
        &mut self,
        symbols: &SymbolState<CONTACTS>,
        [present, released]: [&[Placed]; 2],
        health: &mut Health,
    ) {
        for event in symbols.events(present, released) {
            health.lost += u32::from(self.symbols.events.push(event).is_err());
        }
    }

    /// Queues the ends of contacts whose garment is no longer worn. They precede the `Hello` of the next one,
    /// whose panels and regions have other names.
    pub fn end_contacts(
        &mut self,
        at: (u32, Micros),
        released: &[Placed],
        symbols: &SymbolState<CONTACTS>,
        health: &mut Health,
    ) {
        let Streamed { contacts, symbols: has_symbols, .. } = self.streamed();
        if contacts {
            self.contacts.take(at, [&[], released], false, health);
            (self.contacts.waits, self.parting) = (true, true);
        }
        if has_symbols {
            self.list_regions(at, &[]);
            self.list_events(symbols, [&[], released], health);
        }
    }

    /// Queues that there is no intention: garment or scene have changed, and with them the map's inputs.
    pub fn end_intention(&mut self, at: (u32, Micros)) {
        self.changes.clear();
        self.intent = self.streamed().intent.then(|| intent_report(at, &Meaning::NONE));
    }

    /// Queues what is present of all that is streamed now and was not `before`, and that nothing is present
    /// of what no longer is streamed.
    #[inline(never)] // M0+: out of line
    pub fn tell_present(
        &mut self,
        before: Streamed,
        at: (u32, Micros),
        (present, regions, meaning): (&[Placed], &[RegionState], &Meaning),
        health: &mut Health,
    ) {
        let now = self.streamed();
        if before.contacts != now.contacts && (before.contacts || !present.is_empty()) {
            let present = if now.contacts { present } else { &[] };
            self.contacts.take(at, [present, &[]], false, health);
            self.contacts.waits = true;
        }
        if before.symbols != now.symbols && (before.symbols || !present.is_empty()) {
            self.list_regions(at, if now.symbols { regions } else { &[] });
        }
        if before.intent != now.intent && (before.intent || meaning.leading != Leading::None) {
            let meaning = if now.intent { meaning } else { &Meaning::NONE };
            self.intent = Some(intent_report(at, meaning));
        }
    }
}

fn intent_report((frame, time): (u32, Micros), meaning: &Meaning) -> IntentReport {
    let Meaning { leading, outcome, steps, ref activations, .. } = *meaning;
    IntentReport { frame, time, leading, outcome, steps, concepts: activations.clone() }
}
