//! Distance that a code may have from the baseline before its taxel is active.

use super::scale::UNITY;

/// Terms of the limits: the floor, and whether pressure lowers the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LimitTerms {
    floor: u16,
    direction: Direction,
}

/// Direction in which pressure moves a code. None is 0, so that an empty `Option<LimitTerms>` is all zeros: an
/// image does not hold a state of zeros, but clears the memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Direction {
    Rising = 1,
    Falling = 2,
}

impl LimitTerms {
    /// Terms of a floor, in counts.
    pub fn new(floor: u16, falling: bool) -> LimitTerms {
        LimitTerms { floor, direction: if falling { Direction::Falling } else { Direction::Rising } }
    }

    /// Returns these terms beyond a level, counts.
    pub fn beyond(&self, level: u16) -> LimitTerms {
        LimitTerms { floor: self.floor.saturating_add(level), ..*self }
    }

    /// True if pressure lowers the code.
    pub fn is_falling(&self) -> bool {
        self.direction == Direction::Falling
    }

    /// Largest difference with less pressure than the floor: `(d gain + 2048) >> 12 < floor`.
    pub fn margin(&self, gain: u16) -> u16 {
        let below = (u32::from(self.floor) << 12).saturating_sub(2049);
        below.checked_div(gain.into()).map_or(u16::MAX, |margin| margin.min(0xffff) as u16)
    }

    /// [`LimitTerms::margin`] of unity gain, without a division.
    pub fn margin_of_unity(&self) -> u16 {
        self.floor.saturating_sub(1)
    }

    /// Last inactive code. No code lies beyond 65535 or 0: a taxel whose margin reaches so far is never
    /// active.
    pub fn limit(&self, rest: u16, margin: u16) -> u16 {
        if self.is_falling() { rest.saturating_sub(margin) } else { rest.saturating_add(margin) }
    }

    /// Last inactive code of a taxel on which so many counts press that are no touch.
    pub fn limit_beyond(&self, level: u16, rest: u16, gain: u16) -> u16 {
        if gain != UNITY {
            return self.limit(rest, self.beyond(level).margin(gain));
        }
        // The same, without a division.
        let (rest, margin) = (u32::from(rest), u32::from(self.margin_of_unity()) + u32::from(level));
        let limit = if self.is_falling() { rest.saturating_sub(margin) } else { rest + margin };
        u16::try_from(limit).unwrap_or(u16::MAX)
    }

    /// Limit that no code passes.
    pub fn silent(&self) -> u16 {
        if self.is_falling() { 0 } else { u16::MAX }
    }
}
