//! What presses on a taxel at a seam, and its board's filter withheld.

use taxel_core::garment::Place;

/// What is pressed of what a filter withheld.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamPress {
    /// Number of the taxel.
    pub taxel: u16,
    /// Where that is.
    pub place: Place,
    /// Its pressure, counts.
    pub value: u16,
    /// How much of that the filter withheld, counts.
    pub more: u16,
}
