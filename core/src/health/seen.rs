//! What was seen of one taxel while it was watched.

use crate::format::Code;

/// Its last, lowest and highest code, and how far the code went from frame to frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    last: u16,
    low: u16,
    high: u16,
    travel: u16,
}

impl Seen {
    pub const NOTHING: Seen = Seen { last: 0, low: u16::MAX, high: 0, travel: 0 };

    /// The first code.
    pub fn begin(&mut self, code: Code) {
        *self = Seen { last: code.0, low: code.0, high: code.0, travel: 0 };
    }

    /// The next one. Every frame has some hundred of these: a code that rises is not the lowest one.
    #[inline]
    pub fn see(&mut self, Code(code): Code) {
        // With codes of 16 bits the travel may pass its end: it is told too short then, and the taxel less noisy than it is.
        if code >= self.last {
            self.travel = self.travel.wrapping_add(code - self.last);
            if code > self.high {
                self.high = code;
            }
        } else {
            self.travel = self.travel.wrapping_add(self.last - code);
            if code < self.low {
                self.low = code;
            }
        }
        self.last = code;
    }

    /// Whether the code never changed.
    pub fn is_still(&self) -> bool {
        self.low == self.high
    }

    /// Whether all codes lay within these.
    pub fn is_within(&self, low: u16, high: u16) -> bool {
        self.low >= low && self.high <= high
    }

    /// Bits that are set in its lowest or its highest code.
    pub fn bits(&self) -> u16 {
        self.low | self.high
    }

    /// Sum of the distances from code to code.
    pub fn travel(&self) -> u16 {
        self.travel
    }

    /// How far the code got from that at rest; less where it got to both sides, as a touch does not take it. Without a code at
    /// rest: the distance of the lowest from the highest code.
    pub fn reach(&self, rest: Option<u16>) -> u16 {
        let Some(rest) = rest else { return self.high.saturating_sub(self.low) };
        let (below, above) = (rest.saturating_sub(self.low), self.high.saturating_sub(rest));
        below.max(above) - below.min(above) / 2
    }

    /// Whether the code got to both sides of that at rest, by so much at least.
    pub fn is_around(&self, rest: u16, by: u16) -> bool {
        rest.saturating_sub(self.low) >= by && self.high.saturating_sub(rest) >= by
    }

    /// Lowest and highest pressure, where pressure lowers the code from `full`.
    pub fn pressure(&self, falling: Option<u16>) -> (u16, u16) {
        match falling {
            None => (self.low, self.high),
            Some(full) => (full.saturating_sub(self.high), full.saturating_sub(self.low)),
        }
    }
}
