//! Faulty taxels: silenced, bridged by the filter from their neighbours, and reported.

use super::effects::Effects;
use super::perception::Perception;
use super::setup::Setup;
use crate::format::Code;
use crate::health::{Codes, FaultyTaxel, FoundFaults, Monitor};

/// Watches the taxels.
pub(super) struct TaxelWatch {
    pub monitor: Monitor,
}

impl TaxelWatch {
    pub const fn new() -> TaxelWatch {
        TaxelWatch { monitor: Monitor::new() }
    }

    /// Updates the health of the taxels from the codes of a frame; `touched`: it has a contact; `is_tared`: its
    /// baseline is its own. Returns true on evidence against a line or an input.
    pub fn watch<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        codes: &[Code],
        (touched, is_tared): (bool, bool),
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
        effects: &mut Effects<'_, TAXELS>,
    ) -> bool {
        let Perception { info, setup, state } = perception;
        let Setup { layout, circuit, scene, .. } = &*setup;
        let condition = &mut state.condition;
        let rest = condition.baseline().filter(|_| is_tared);
        let shown = Codes { now: codes, rest, full: info.full_scale, touched };
        let is_suspect = self.monitor.needs_retest(circuit, &scene.plan, &shown);
        let well = self.monitor.clear_fault(circuit, &shown);
        let mut found = FoundFaults::new();
        self.monitor.watch(layout, circuit, &scene.plan, shown, &mut found);
        if let Some(well) = well {
            condition.set_gain(usize::from(well.taxel), well.gain);
            effects.outbox.map_changed();
        }
        for (taxel, health) in &found {
            let gain = condition.gain().get(usize::from(*taxel)).copied().unwrap_or(0);
            if self.monitor.add(FaultyTaxel { taxel: *taxel, health: *health, gain }) {
                condition.set_gain(usize::from(*taxel), 0);
                effects.outbox.map_changed();
            }
        }
        is_suspect
    }

    /// Sets the gain of a taxel; a faulty one gets it when its fault is cleared.
    pub fn put_gain<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        taxel: usize,
        gain: u16,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    ) {
        match self.monitor.faulty_mut(taxel) {
            Some(faulty) => faulty.gain = gain,
            None => _ = perception.state.condition.set_gain(taxel, gain),
        }
    }

    /// Clears all faults: restores the gains saved before the taxels were silenced, and watches them anew.
    pub fn recover<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
        effects: &mut Effects<'_, TAXELS>,
    ) {
        for faulty in self.monitor.faulty() {
            perception.state.condition.set_gain(usize::from(faulty.taxel), faulty.gain);
        }
        self.monitor.reset();
        effects.outbox.map_changed();
    }
}
