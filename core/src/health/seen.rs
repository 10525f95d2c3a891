//! Statistics of one taxel's codes while it is watched.

use crate::format::Code;

/// Last, lowest and highest code of a taxel, and the distance that its code has travelled from frame to
/// frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Last code in the lower 16 bits, travel in the upper 16: one word is loaded and stored instead of two
    /// halves.
    course: u32,
    low: u16,
    high: u16,
}

impl Seen {
    /// All bytes are 0.
    pub const BLANK: Seen = Seen { course: 0, low: 0, high: 0 };

    /// Statistics without a code.
    pub const NOTHING: Seen = Seen { course: 0, low: u16::MAX, high: 0 };

    /// Takes the first code.
    pub fn begin(&mut self, Code(code): Code) {
        *self = Seen { course: code.into(), low: code, high: code };
    }

    /// Takes the next code. This runs some hundred times a frame, so a rising code is not compared with the
    /// lowest.
    #[inline]
    pub fn see(&mut self, Code(code): Code) {
        let (code_now, last) = (u32::from(code), self.course & 0xffff);
        // With codes of 16 bits the travel may wrap: it is then too small, and the taxel seems less noisy
        // than it is.
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

    /// True if the code never changed.
    pub fn is_still(&self) -> bool {
        self.low == self.high
    }

    /// True if all codes lay within `low ..= high`.
    pub fn is_within(&self, low: u16, high: u16) -> bool {
        self.low >= low && self.high <= high
    }

    /// Bits that are set in the lowest or the highest code.
    pub fn bits(&self) -> u16 {
        self.low | self.high
    }

    /// Sum of the distances from code to code, counts.
    pub fn travel(&self) -> u16 {
        (self.course >> 16) as u16
    }

    /// Distance of the code from that at rest; reduced if the code got to both sides, which a touch does not
    /// cause. Without a code at rest: distance of the lowest from the highest code.
    pub fn reach(&self, rest: Option<u16>) -> u16 {
        let Some(rest) = rest else { return self.high.saturating_sub(self.low) };
        let (below, above) = (rest.saturating_sub(self.low), self.high.saturating_sub(rest));
        below.max(above) - below.min(above) / 2
    }

    /// True if the code got to both sides of that at rest, by at least `by` counts.
    pub fn is_around(&self, rest: u16, by: u16) -> bool {
        rest.saturating_sub(self.low) >= by && self.high.saturating_sub(rest) >= by
    }

    /// Lowest and highest pressure; `falling` is full scale where pressure lowers the code.
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
