//! What was seen of one taxel while it was watched.

use crate::format::Code;

/// Its last, lowest and highest code, and how far the code went from frame to frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// The last code, and above its 16 bits how far the code has travelled: one word is read and written
    /// where two halves would be.
    course: u32,
    low: u16,
    high: u16,
}

impl Seen {
    pub const NOTHING: Seen = Seen { course: 0, low: u16::MAX, high: 0 };

    /// The first code.
    pub fn begin(&mut self, Code(code): Code) {
        *self = Seen { course: code.into(), low: code, high: code };
    }

    /// The next one. Every frame has some hundred of these: a code that rises is not the lowest one.
    #[inline]
    pub fn see(&mut self, Code(code): Code) {
        let (code_now, last) = (u32::from(code), self.course & 0xffff);
        // With codes of 16 bits the travel may pass its end: it is told too short then, and the taxel less
        // noisy than it is.
        if code_now >= last {
            let way = code_now - last;
            self.course = self.course.wrapping_add(way << 16).wrapping_add(way);
            if code > self.high {
                self.high = code;
            }
        } else {
            let way = last - code_now;
            self.course = self.course.wrapping_add(way << 16).wrapping_sub(way);
            if code < self.low {
                self.low = code;
            }
        }
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
        (self.course >> 16) as u16
    }

    /// How far the code got from that at rest; less where it got to both sides, as a touch does not take it.
    /// Without a code at rest: the distance of the lowest from the highest code.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_is_followed_code_by_code() {
        let mut state = 1u32;
        for round in 0..2000 {
            let mut next = || {
                state = state.wrapping_mul(1664525).wrapping_add(1013904223);
                [(state >> 16) as u16, (state >> 20) as u16, 0, u16::MAX, 2000 + (state >> 29) as u16]
                    [round % 5]
            };
            let codes: [u16; 11] = core::array::from_fn(|_| next());
            let mut seen = Seen::NOTHING;
            seen.begin(Code(codes[0]));
            codes[1..].iter().for_each(|code| seen.see(Code(*code)));
            let travel = codes.windows(2).fold(0u16, |sum, pair| sum.wrapping_add(pair[0].abs_diff(pair[1])));
            let (low, high) = (codes.iter().copied().min().unwrap(), codes.iter().copied().max().unwrap());
            assert_eq!((seen.travel(), seen.low, seen.high), (travel, low, high));
            assert_eq!(seen.course & 0xffff, u32::from(codes[10]));
        }
    }
}
