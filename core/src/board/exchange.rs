//! Change of scene or garment while reactions last: those that continue keep their pin, all others are
//! reported as ended.

use super::Board;
use crate::format::Micros;
use crate::react::{REACTIONS, Reaction, ReactionConfig};
use crate::wire::ReactionReport;

/// By row: time at which its value last reached its level, if the reaction lasts.
pub(super) type Lasting = [Option<Micros>; REACTIONS];

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Reactions that last.
    pub(super) fn lasting(&self) -> Lasting {
        *self.state.react().since()
    }

    /// Carries lasting reactions of the previous table over to the scene in force. Rows of the same name and
    /// pin continue: their pins stay, and from the next frame on the new levels decide. All others end.
    #[inline(never)] // M0+: out of line
    pub(super) fn carry(&mut self, lasting: &Lasting, before: &[ReactionConfig], now: Micros) {
        for (index, (row, since)) in (0..).zip(before.iter().zip(lasting)) {
            let Some(since) = *since else { continue };
            let goes_on = |new: &ReactionConfig| new.name == row.name && new.output == row.output;
            let Some(place) = self.setup.scene.react.iter().position(goes_on) else {
                self.end(index, row, now);
                continue;
            };
            self.state.react_mut().go_on(place, since);
            if let Some(line) = row.output {
                self.outputs.set(line.pin, !line.inverted);
            }
        }
    }

    /// Another garment: ends the reactions to touch. Reactions to the board's own state continue.
    #[inline(never)] // M0+: out of line
    pub(super) fn end_all(&mut self, lasting: &Lasting, now: Micros) {
        for (index, since) in lasting.iter().enumerate() {
            let Some((row, since)) = self.setup.scene.react.get(index).cloned().zip(*since) else { continue };
            if row.cause.is_of_board() {
                self.state.react_mut().go_on(index, since);
                self.stand(index as u8);
            } else {
                self.end(index as u8, &row, now);
            }
        }
    }

    /// Reports the reactions that last to a newly connected host, each with the level at which it began.
    pub(super) fn tell_lasting(&mut self, now: Micros) {
        for (index, (row, since)) in (0..).zip(self.setup.scene.react.iter().zip(self.lasting())) {
            if since.is_some() {
                let reaction = Reaction { index, name: row.name.clone(), active: true, value: row.level };
                let report = ReactionReport { frame: self.frame, time: now, reaction };
                self.outbox.reaction(report, &mut self.health);
            }
        }
    }

    fn end(&mut self, index: u8, row: &ReactionConfig, now: Micros) {
        let reaction = Reaction { index, name: row.name.clone(), active: false, value: 0 };
        self.outbox.reaction(ReactionReport { frame: self.frame, time: now, reaction }, &mut self.health);
    }
}
