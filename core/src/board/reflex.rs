//! Reactions that began within a frame: what is watched for them, and what comes of them.

use super::Board;
use crate::reflex::{Early, Reflexes};
use crate::wire::ReflexReport;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// What is to be watched in each sub-field; none while a tare runs.
    pub fn reflexes(&self) -> Option<&Reflexes> {
        self.state.condition.baseline().map(|_| self.setup.pipeline.reactions().reflexes())
    }

    /// Reactions that last, a bit for each row of the scene's table.
    pub fn reacting(&self) -> u8 {
        self.state.reacting()
    }

    /// The last code of a taxel that begins no reflex; none where no row watches it.
    pub fn quiet_code(&self, taxel: u16) -> Option<u16> {
        let row = self.setup.pipeline.reactions().reflexes().row_of(taxel)?;
        Some(self.state.condition.quiet_code(taxel.into(), row.level, self.setup.circuit.falling()))
    }

    /// A reflex began; its pin has been asserted.
    pub(super) fn reflex(&mut self, early: &Early) {
        let Early { index, time, taxel, code, other } = *early;
        let value = self.state.condition.pressure(taxel.into(), code, self.setup.circuit.falling());
        let reactions = self.setup.pipeline.reactions();
        if !reactions.reflexes().rows().iter().any(|row| row.index == index) {
            // It is of a scene that was there before.
            return;
        }
        let reaction = self.state.begin_reaction(reactions, index, value, time);
        if let Some(line) = reactions.output(index) {
            self.outputs.set(line.pin, !line.inverted);
        }
        // Told after the frame that was perceived last, it may have begun in the one that is being scanned.
        let frame = self.frame.wrapping_add((time > self.ledger.scanned()).into());
        let report = ReflexReport { frame, time, index, taxel, value, other };
        self.outbox.reflex(report, reaction, &mut self.health);
    }
}
