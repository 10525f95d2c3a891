//! Lowest and highest of a set of codes.

/// Lowest and highest of a set of codes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremes {
    pub low: u16,
    pub high: u16,
}

impl Extremes {
    /// Extremes of no code: any code is lower, and higher.
    pub const NONE: Extremes = Extremes { low: u16::MAX, high: 0 };

    /// Adds a code.
    pub fn take(&mut self, code: u16) {
        (self.low, self.high) = (self.low.min(code), self.high.max(code));
    }

    /// Distance of the two; 0 of no code.
    pub const fn width(&self) -> u16 {
        self.high.saturating_sub(self.low)
    }
}
