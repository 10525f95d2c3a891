//! What one filter over both panels of a seam would have changed.

use taxel_core::garment::Place;

/// A taxel at a seam, as its board told it, and as it is with what presses beyond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamChange {
    /// Number of the taxel.
    pub taxel: u16,
    /// Where that is.
    pub place: Place,
    /// Its pressure as its board told it, counts.
    pub told: u16,
    /// Its pressure, counts.
    pub value: u16,
}
