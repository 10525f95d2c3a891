//! The board's own state: its values for reactions, and the expiry of fed concepts when the host is silent.

use super::Board;
use crate::format::Micros;
use crate::react::{Cause, Reaction, Reactions};
use crate::wire::ReactionReport;

/// Silence after which the host counts as gone, so that concepts it has fed expire.
const SILENCE_US: u64 = 3_000_000;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Records a perceived frame and shows it on its pins. During a tare no frame counts as perceived.
    pub(super) fn saw(&mut self, now: Micros) {
        if self.state.condition.baseline().is_none() {
            return self.senses.blind();
        }
        self.senses.seen = Some(now);
        self.senses.frames = self.senses.frames.wrapping_add(1);
        self.show_frames();
    }

    /// Sets the pins that show perceived frames to their levels for the present count.
    pub(super) fn show_frames(&mut self) {
        for (pin, level) in self.setup.pipeline.reactions().watching(self.senses.frames) {
            self.outputs.set(pin, level);
        }
    }

    /// Updates what depends on the board's own state.
    pub(super) fn look_after(&mut self, now: Micros) {
        if now.since(self.senses.heard) >= SILENCE_US {
            self.state.fed.let_go();
        }
        if self.setup.pipeline.reactions().alarms().next().is_some() {
            self.judge_alarms(now);
        }
    }

    #[inline(never)] // M0+: out of line
    fn judge_alarms(&mut self, now: Micros) {
        let mut changes = heapless::Vec::<Reaction, { crate::react::REACTIONS }>::new();
        let reactions = self.setup.pipeline.reactions();
        for (index, cause, region) in reactions.alarms() {
            let value = match cause {
                Cause::Fault => self.faults(),
                Cause::Blind => self.senses.seen.map_or(i32::MAX, |seen| ms(now, seen)),
                Cause::Faulty => self.faulty_in(region),
                Cause::Silent => ms(now, self.senses.heard),
                // All other causes are judged by frames, or not at all.
                _ => continue,
            };
            if let Some(change) = reactions.judge(self.state.react_mut(), index, value, now) {
                // There is room for all rows.
                let _ = changes.push(change);
            }
        }
        for reaction in &changes {
            self.stand(reaction.index);
            let report = ReactionReport { frame: self.frame, time: now, reaction: reaction.clone() };
            self.outbox.reaction(report, &mut self.health);
        }
    }

    /// Sets the pin of a row to the level that all rows of that pin require.
    pub(super) fn stand(&mut self, index: u8) {
        let Board { setup, state, outputs, .. } = self;
        if let Some((pin, level)) = Reactions::pin(setup.pipeline.reactions(), state.react(), index) {
            outputs.set(pin, level);
        }
    }

    fn faults(&self) -> i32 {
        let known = self.examined.as_ref().map_or(0, |report| report.findings.faults.len());
        known as i32 + i32::from(self.stumbles > 0)
    }

    fn faulty_in(&self, region: Option<u8>) -> i32 {
        let layout = &self.setup.layout;
        let of = |taxel: u16| {
            let place = layout.place(taxel.into())?;
            layout.areas().get(usize::from(place.panel)).map(|area| area.region)
        };
        let there =
            self.monitor.faulty().iter().filter(|faulty| region.is_none() || of(faulty.taxel) == region);
        there.count() as i32
    }
}

/// Time since `then`, ms; saturates.
fn ms(now: Micros, then: Micros) -> i32 {
    i32::try_from(now.millis_since(then)).unwrap_or(i32::MAX)
}
