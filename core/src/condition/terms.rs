//! How far the code of a taxel may go before it counts.

/// What the limits are for: the floor, and whether pressure lowers the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Terms {
    pub floor: u16,
    pub falling: bool,
}

impl Terms {
    /// The greatest difference that comes to less than the floor: `(d gain + 2048) >> 12 < floor`.
    pub fn margin(&self, gain: u16) -> u16 {
        let below = (u32::from(self.floor) << 12).saturating_sub(2049);
        below.checked_div(gain.into()).map_or(u16::MAX, |margin| margin.min(0xffff) as u16)
    }

    /// The same of a gain of 1, which needs no division.
    pub fn margin_of_unity(&self) -> u16 {
        self.floor.saturating_sub(1)
    }

    /// The last code that is quiet. No code is beyond 65535, or 0: where the margin reaches so far, none is
    /// loud.
    pub fn limit(&self, rest: u16, margin: u16) -> u16 {
        if self.falling { rest.saturating_sub(margin) } else { rest.saturating_add(margin) }
    }

    /// The limit that no code passes.
    pub fn silent(&self) -> u16 {
        if self.falling { 0 } else { u16::MAX }
    }
}
