//! Lowest and highest of some codes.

/// The lowest and the highest of some codes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremes {
    pub low: u16,
    pub high: u16,
}

impl Extremes {
    /// Of none: any code is lower, and higher.
    pub const NONE: Extremes = Extremes { low: u16::MAX, high: 0 };

    /// Takes in another.
    pub fn take(&mut self, code: u16) {
        (self.low, self.high) = (self.low.min(code), self.high.max(code));
    }

    /// How far apart they are; 0 of none.
    pub const fn width(&self) -> u16 {
        self.high.saturating_sub(self.low)
    }
}
