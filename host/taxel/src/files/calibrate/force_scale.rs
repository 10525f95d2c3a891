//! Scales from counts to newtons that a host knows of a board.

use super::basis::ForceBasis;
use super::file::Calibration;
use super::force::Forces;
use super::newtons::Newtons;
use std::sync::Arc;
use taxel_core::garment::Layout;

/// Scales from counts to newtons that a host knows of a board.
#[derive(Debug, Clone, Default)]
pub struct ForceScale {
    calibration: Option<Arc<Calibration>>,
    counts_per_newton: Option<f32>,
}

impl ForceScale {
    /// The scale of a source, in counts per newton on a taxel, and a calibration, which counts instead while the
    /// board uses it.
    pub fn new(calibration: Option<Calibration>, counts_per_newton: Option<f32>) -> ForceScale {
        let counts_per_newton = counts_per_newton.filter(|counts| counts.is_finite() && *counts > 0.0);
        ForceScale { calibration: calibration.map(Arc::new), counts_per_newton }
    }

    /// A copy with this calibration, if there is one.
    pub fn with(&self, calibration: Option<&Calibration>) -> ForceScale {
        let calibration = calibration.cloned().map(Arc::new).or_else(|| self.calibration.clone());
        ForceScale { calibration, ..self.clone() }
    }

    /// The calibration.
    pub fn calibration(&self) -> Option<&Calibration> {
        self.calibration.as_deref()
    }

    /// Counts per newton of the source, whatever the calibration says.
    pub(crate) fn source_counts_per_newton(&self) -> Option<f32> {
        self.counts_per_newton
    }

    /// Newtons on a garment whose board reports this calibration. A calibration of another garment counts as none.
    pub fn on(&self, layout: &Layout, in_force: &str, is_simulated: bool) -> Newtons {
        let calibration = self.calibration().filter(|calibration| calibration.is_in_force(in_force));
        let forces = calibration.and_then(|calibration| Forces::new(calibration, layout).ok());
        let mean = calibration.filter(|_| forces.is_some()).and_then(Calibration::counts_per_newton);
        let straight = mean.or(self.counts_per_newton);
        let basis = match (&forces, is_simulated) {
            (Some(_), _) => Some(ForceBasis::Calibrated),
            (None, true) => straight.map(|_| ForceBasis::Simulated),
            (None, false) => straight.map(|_| ForceBasis::Nominal),
        };
        Newtons::new(forces, straight, basis)
    }
}
