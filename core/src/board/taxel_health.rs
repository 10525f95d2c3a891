//! Faulty taxels: silenced, bridged by the filter from their neighbours, and reported.

use super::Board;
use crate::format::{Code, Micros};
use crate::health::{Codes, FaultyTaxel, FoundFaults, TaxelHealth};

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Updates the health of the taxels from the codes of a frame; `touched`: it has a contact.
    pub(super) fn watch(&mut self, now: Micros, codes: &[Code], touched: bool) {
        let super::Setup { layout, circuit, scene, .. } = &self.setup;
        let condition = &mut self.state.condition;
        let rest = condition.baseline().filter(|_| self.tared);
        let shown = Codes { now: codes, rest, full: self.info.full_scale, touched };
        if self.monitor.needs_retest(circuit, &scene.plan, &shown) {
            self.retest.raise(now);
        }
        let well = self.monitor.clear_fault(circuit, &shown);
        let mut found = FoundFaults::new();
        self.monitor.watch(layout, circuit, &scene.plan, shown, &mut found);
        if let Some(well) = well {
            condition.set_gain(usize::from(well.taxel), well.gain);
            self.outbox.map_changed();
        }
        for (taxel, health) in &found {
            let gain = condition.gain().get(usize::from(*taxel)).copied().unwrap_or(0);
            if self.monitor.add(FaultyTaxel { taxel: *taxel, health: *health, gain }) {
                condition.set_gain(usize::from(*taxel), 0);
                self.outbox.map_changed();
            }
        }
    }

    /// Sets the gain of a taxel; a faulty one gets it when its fault is cleared.
    pub(super) fn put_gain(&mut self, taxel: usize, gain: u16) {
        match self.monitor.faulty_mut(taxel) {
            Some(faulty) => faulty.gain = gain,
            None => {
                self.state.condition.set_gain(taxel, gain);
            }
        }
    }

    /// Clears all faults: restores the gains saved before the taxels were silenced, and watches them anew.
    pub(super) fn recover(&mut self) {
        for faulty in self.monitor.faulty() {
            self.state.condition.set_gain(usize::from(faulty.taxel), faulty.gain);
        }
        self.monitor.reset();
        self.outbox.map_changed();
    }

    /// Health of a taxel.
    pub fn health_of(&self, taxel: usize) -> TaxelHealth {
        self.monitor.health(taxel)
    }
}
