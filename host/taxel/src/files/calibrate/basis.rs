//! Basis of forces in newtons.

/// Basis of forces in newtons.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceBasis {
    /// The calibration in force.
    Calibrated,
    /// A gain that no calibration of this garment has measured.
    Nominal,
    /// Newtons of a simulation's script.
    Simulated,
}

impl ForceBasis {
    /// The word beside a force.
    pub fn as_str(self) -> &'static str {
        match self {
            ForceBasis::Calibrated => "calibrated",
            ForceBasis::Nominal => "nominal",
            ForceBasis::Simulated => "simulated",
        }
    }
}
