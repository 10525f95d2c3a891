//! The bytes of four taxels in a word: all four are computed with at once.
//!
//! Sums of bytes take two words, of 16 bits for each of the even and of the odd bytes.

/// Bytes 0 and 2.
const EVEN: u32 = 0x00FF_00FF;
/// The highest bit of each byte.
const HIGH: u32 = 0x8080_8080;
/// 1 for each sum of a word.
const ONE: u32 = 0x0001_0001;
/// Most of the weights that a sum may have together: two bytes with all of it fill 16 bits.
pub(super) const WHOLE: u16 = 128;
/// log2 of [`WHOLE`].
const SHIFT: u32 = 7;

/// Excess of a correction's byte over the correction: 0 stands for none yet.
pub(super) const ZERO: u32 = 128;

/// Levels of four taxels, counts, two in a word.
pub(crate) type LevelPairs = [u32; 2];

/// Weighted sums of the bytes of words.
#[derive(Debug, Clone, Copy)]
pub(super) struct LaneSums {
    even: u32,
    odd: u32,
}

impl LaneSums {
    /// Nothing yet.
    pub const ZERO: LaneSums = LaneSums { even: 0, odd: 0 };

    /// Nothing yet: half of a unit, so that [`LaneSums::lanes`] rounds.
    pub const NONE: LaneSums = LaneSums { even: ONE << (SHIFT - 1), odd: ONE << (SHIFT - 1) };

    /// Nothing yet: almost a unit, so that [`LaneSums::lanes`] rounds up.
    pub const ALMOST: LaneSums = LaneSums { even: ONE * (WHOLE as u32 - 1), odd: ONE * (WHOLE as u32 - 1) };

    /// Returns the expected pressure at a knot: means and corrections together, within 0 and 255.
    #[inline(always)]
    pub fn at_knot(means: u32, corrections: u32) -> LaneSums {
        // 128 stands for a correction of 0, as 0 does for none yet.
        let corrections = corrections | zeros(corrections);
        // The highest bit of a lane stays as long as what is left is not below 0.
        let less = |shift: u32| {
            let sum = (means >> shift & EVEN).wrapping_add(corrections >> shift & EVEN);
            (sum | ONE << 15).wrapping_sub(ONE * ZERO)
        };
        let (even, odd) = (less(0), less(8));
        if (even | odd) & (ONE * 0x7F00) == 0 {
            return LaneSums { even: even & EVEN, odd: odd & EVEN };
        }
        LaneSums { even: limited(even), odd: limited(odd) }
    }

    /// Two knots as a start, with half of a unit, so that [`LaneSums::lanes`] rounds, and the step from there
    /// to the second one for a weight of 1: see [`LaneSums::toward`].
    #[inline(always)]
    pub fn ends(first: LaneSums, last: LaneSums) -> [LaneSums; 2] {
        let start = |sums: u32| sums.wrapping_mul(WHOLE.into()).wrapping_add(ONE << (SHIFT - 1));
        let step = |first: u32, last: u32| last.wrapping_sub(first);
        [
            LaneSums { even: start(first.even), odd: start(first.odd) },
            LaneSums { even: step(first.even, last.even), odd: step(first.odd, last.odd) },
        ]
    }

    /// The knot that counts `weight` and the one that counts the rest. A step may borrow from the
    /// next lane; its product with the weight gives that back.
    #[inline(always)]
    pub fn toward(&self, step: &LaneSums, weight: u32) -> LaneSums {
        let sum = |start: u32, step: u32| start.wrapping_add(step.wrapping_mul(weight));
        LaneSums { even: sum(self.even, step.even), odd: sum(self.odd, step.odd) }
    }

    /// Adds `weight` of each byte.
    #[inline(always)]
    pub fn add(&mut self, bytes: u32, weight: u32) {
        self.even = self.even.wrapping_add((bytes & EVEN).wrapping_mul(weight));
        self.odd = self.odd.wrapping_add((bytes >> 8 & EVEN).wrapping_mul(weight));
    }

    /// Adds `weight` of bytes in lanes.
    #[inline(always)]
    pub fn add_lanes(&mut self, lanes: &LaneSums, weight: u32) {
        *self = self.toward(lanes, weight);
    }

    /// The sum of all sums.
    pub fn total(self) -> u32 {
        let [even, odd] = [self.even, self.odd].map(|sums| (sums & 0xFFFF) + (sums >> 16));
        even + odd
    }

    /// Each sum divided by [`WHOLE`]: none is above 255.
    #[inline(always)]
    pub fn lanes(&self) -> LaneSums {
        LaneSums { even: self.even >> SHIFT & EVEN, odd: self.odd >> SHIFT & EVEN }
    }

    /// Sums that are bytes.
    #[inline(always)]
    pub fn bytes(&self) -> u32 {
        self.even | self.odd << 8
    }

    /// The sum of each lane, which is a byte, and each byte, times `unit`, at most 128: each product fits in
    /// its half of a word. In the order of the bytes.
    #[inline(always)]
    pub fn levels(&self, bytes: u32, unit: u32) -> LevelPairs {
        let sum = |lanes: u32, bytes: u32| (lanes.wrapping_add(bytes & EVEN)).wrapping_mul(unit);
        let (even, odd) = (sum(self.even, bytes), sum(self.odd, bytes >> 8));
        [even & 0xFFFF | odd << 16, even >> 16 | odd & 0xFFFF_0000]
    }
}

/// The sum of each two bytes, at most 255.
#[inline(always)]
pub(super) fn both(a: u32, b: u32) -> u32 {
    if (a | b) & HIGH == 0 {
        return a.wrapping_add(b);
    }
    let [even, odd] = [0, 8].map(|shift| (a >> shift & EVEN) + (b >> shift & EVEN));
    limited(even | ONE << 15) | limited(odd | ONE << 15) << 8
}

/// Differences, which have their highest bit as long as they are not below 0, within 0 and 255.
#[inline(never)] // seldom
fn limited(rest: u32) -> u32 {
    let rest = rest & (rest >> 15 & ONE).wrapping_mul(0x7FFF);
    (rest | (rest >> 8 & ONE).wrapping_mul(0xFF)) & EVEN
}

/// The highest bit of each byte that is 0.
#[inline(always)]
pub(super) fn zeros(bytes: u32) -> u32 {
    let low = 0x7F7F_7F7F;
    !((bytes & low).wrapping_add(low) | bytes | low)
}

/// All bits of each byte whose highest bit is set in `flags`, which has no other bits.
#[inline(always)]
pub(super) fn whole_bytes(flags: u32) -> u32 {
    (flags >> 7).wrapping_mul(0xFF)
}

/// Each byte, times `unit`, see [`LaneSums::levels`].
#[inline(always)]
pub(super) fn times(bytes: u32, unit: u32) -> LevelPairs {
    LaneSums::ZERO.levels(bytes, unit)
}

/// The sum of each two bytes, times `unit`, see [`LaneSums::levels`].
#[inline(always)]
pub(super) fn summed(a: u32, b: u32, unit: u32) -> LevelPairs {
    LaneSums { even: a & EVEN, odd: a >> 8 & EVEN }.levels(b, unit)
}

/// Byte number `lane`, 0 ..= 3.
pub(super) fn byte(bytes: u32, lane: usize) -> u8 {
    bytes.to_le_bytes().get(lane).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn four_lanes_are_four_bytes(
            a in any::<[u8; 4]>(), b in any::<[u8; 4]>(), c in any::<[u8; 4]>(), d in any::<[u8; 4]>(),
            weight in 0u32..=128,
        ) {
            let [wa, wb, wc, wd] = [a, b, c, d].map(u32::from_le_bytes);
            let knot = |mean: u8, correction: u8| {
                let correction = if correction == 0 { 128 } else { u32::from(correction) };
                (u32::from(mean) + correction).saturating_sub(128).min(255)
            };
            let (first, last) = (LaneSums::at_knot(wa, wb), LaneSums::at_knot(wc, wd));
            let want = core::array::from_fn(|i| {
                ((knot(a[i], b[i]) * (128 - weight) + knot(c[i], d[i]) * weight + 64) / 128) as u8
            });
            let mut sums = LaneSums::NONE;
            sums.add_lanes(&first, 128 - weight);
            sums.add_lanes(&last, weight);
            prop_assert_eq!(sums.lanes().bytes().to_le_bytes(), want);
            let [start, step] = LaneSums::ends(first, last);
            prop_assert_eq!(start.toward(&step, weight).lanes().bytes().to_le_bytes(), want);
            let mut sums = LaneSums::NONE;
            sums.add(wa, weight);
            let want = a.map(|a| ((u32::from(a) * weight + 64) / 128) as u8);
            prop_assert_eq!(sums.lanes().bytes().to_le_bytes(), want);
            let want = core::array::from_fn(|i| a[i].saturating_add(b[i]));
            prop_assert_eq!(both(wa, wb).to_le_bytes(), want);
            let [small, smaller] = [wa, wb].map(|word| word & 0x7F7F_7F7F);
            let want = core::array::from_fn(|i| small.to_le_bytes()[i] + smaller.to_le_bytes()[i]);
            prop_assert_eq!(both(small, smaller).to_le_bytes(), want);
            let mut sums = LaneSums::ZERO;
            sums.add(wa, 1);
            prop_assert_eq!(sums.total(), a.map(u32::from).iter().sum());
            let mut sums = LaneSums::ALMOST;
            sums.add(wa, weight);
            let want = a.map(|a| (u32::from(a) * weight).div_ceil(128) as u8);
            prop_assert_eq!(sums.lanes().bytes().to_le_bytes(), want);
        }

        #[test]
        fn zeros_are_found_by_byte(bytes in prop::array::uniform4(prop_oneof![Just(0u8), Just(1), any::<u8>()])) {
            let found = zeros(u32::from_le_bytes(bytes));
            prop_assert_eq!(found.to_le_bytes(), bytes.map(|byte| if byte == 0 { 0x80 } else { 0 }));
            let whole = whole_bytes(found).to_le_bytes();
            prop_assert_eq!(whole, bytes.map(|byte| if byte == 0 { 0xFF } else { 0 }));
        }

        #[test]
        fn sums_are_those_of_the_bytes(a in any::<[u8; 4]>(), b in any::<[u8; 4]>(), unit in 0u32..=128) {
            let [x, y] = [a, b].map(u32::from_le_bytes);
            let want: [u32; 4] = core::array::from_fn(|i| (u32::from(a[i]) + u32::from(b[i])) * unit);
            let apart = |[first, second]: LevelPairs| {
                [first & 0xFFFF, first >> 16, second & 0xFFFF, second >> 16]
            };
            prop_assert_eq!(apart(summed(x, y, unit)), want);
            prop_assert_eq!(apart(times(x, unit)), a.map(|a| u32::from(a) * unit));
        }
    }
}
