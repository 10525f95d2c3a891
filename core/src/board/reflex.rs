//! Reactions that begin within a frame: their limits, and their reports.

use super::Board;
use crate::reflex::{Early, Reflexes};
use crate::wire::ReflexReport;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Reflexes to watch in each sub-field; none during a tare.
    pub fn reflexes(&self) -> Option<&Reflexes> {
        self.state.condition.baseline().map(|_| self.setup.pipeline.reactions().reflexes())
    }

    /// Mask of the reactions that last, by row of the scene's table.
    pub fn reacting(&self) -> u8 {
        self.state.reacting()
    }

    /// Last code of a taxel that begins no reflex; none if no row watches the taxel.
    pub fn inactive_code(&self, taxel: u16) -> Option<u16> {
        let row = self.setup.pipeline.reactions().reflexes().row_of(taxel)?;
        Some(self.state.condition.inactive_code(taxel.into(), row.level, self.setup.circuit.falling()))
    }

    /// Takes a reflex that began, whose pin has been asserted.
    pub(super) fn reflex(&mut self, early: &Early) {
        let Early { index, time, taxel, code, other } = *early;
        let value = self.state.condition.pressure(taxel.into(), code, self.setup.circuit.falling());
        let reactions = self.setup.pipeline.reactions();
        if !reactions.reflexes().rows().iter().any(|row| row.index == index) {
            // The row belongs to a previous scene.
            return;
        }
        let reaction = self.state.begin_reaction(reactions, index, value, time);
        if let Some(line) = reactions.output(index) {
            self.outputs.set(line.pin, !line.inverted);
        }
        // It may have begun in the frame being scanned, after the one perceived last.
        let frame = self.frame.wrapping_add((time > self.ledger.scanned()).into());
        let report = ReflexReport { frame, time, index, taxel, value, other };
        self.outbox.reflex(report, reaction, &mut self.health);
    }
}
