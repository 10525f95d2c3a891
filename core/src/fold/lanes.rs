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

/// What a byte of a correction is more than the correction: 0 stands for none yet.
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

    /// Nothing yet: almost a unit, so that [`LaneSums::within`] rounds up.
    pub const ALMOST: LaneSums = LaneSums { even: ONE * (WHOLE as u32 - 1), odd: ONE * (WHOLE as u32 - 1) };

    /// The sum of each two bytes.
    #[inline(always)]
    pub fn of([a, b]: [u32; 2]) -> LaneSums {
        let [even, odd] = [0, 8].map(|shift| (a >> shift & EVEN).wrapping_add(b >> shift & EVEN));
        LaneSums { even, odd }
    }

    /// Two sums of two bytes each as a start, with half of a unit, so that [`LaneSums::lanes`] rounds, and the
    /// step from there to the second one for a weight of 1: see [`LaneSums::toward`].
    #[inline(always)]
    pub fn ends(first: LaneSums, last: LaneSums) -> [LaneSums; 2] {
        let start = |sums: u32| sums.wrapping_mul(WHOLE.into()).wrapping_add(ONE << (SHIFT - 1));
        let step = |first: u32, last: u32| last.wrapping_sub(first);
        [
            LaneSums { even: start(first.even), odd: start(first.odd) },
            LaneSums { even: step(first.even, last.even), odd: step(first.odd, last.odd) },
        ]
    }

    /// The sum of two bytes that counts `weight` and that which counts the rest. A step may borrow from the
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

    /// Adds `weight` of the sum of each two bytes.
    #[inline(always)]
    pub fn add_both(&mut self, [a, b]: [u32; 2], weight: u32) {
        self.even = self.even.wrapping_add((a & EVEN).wrapping_add(b & EVEN).wrapping_mul(weight));
        self.odd = self.odd.wrapping_add((a >> 8 & EVEN).wrapping_add(b >> 8 & EVEN).wrapping_mul(weight));
    }

    /// The sum of all sums.
    pub fn total(self) -> u32 {
        let [even, odd] = [self.even, self.odd].map(|sums| (sums & 0xFFFF) + (sums >> 16));
        even + odd
    }

    /// Each sum divided by [`WHOLE`], less [`ZERO`], within 0 and 255.
    #[inline(always)]
    pub fn lanes(&self) -> LaneSums {
        // Of the two highest bits of a sum exactly one is set where what is left is within these.
        let is_out = !(self.even ^ self.even << 1) | !(self.odd ^ self.odd << 1);
        if is_out & ONE << 15 == 0 {
            // What is less by 128 has another eighth bit.
            let [even, odd] = [self.even, self.odd].map(|sums| (sums >> SHIFT & EVEN) ^ (ONE * ZERO));
            return LaneSums { even, odd };
        }
        LaneSums { even: clamped(self.even), odd: clamped(self.odd) }
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

    /// Each sum divided by [`WHOLE`]: none is above 255.
    #[inline(always)]
    pub fn within(self) -> u32 {
        self.even >> SHIFT & EVEN | (self.odd >> SHIFT & EVEN) << 8
    }
}

/// Sums divided by [`WHOLE`], less [`ZERO`], within 0 and 255.
#[inline(never)] // seldom
fn clamped(sums: u32) -> u32 {
    // The highest bit stays as long as the sum is not less.
    let rest = (sums >> SHIFT & (ONE * 0x1FF) | ONE << 15).wrapping_sub(ONE * ZERO);
    limited(rest)
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
            let mut sums = LaneSums::NONE;
            let [wa, wb, wc, wd] = [a, b, c, d].map(u32::from_le_bytes);
            sums.add_both([wa, wb], weight);
            sums.add_both([wc, wd], 128 - weight);
            let sum = |a: u8, b: u8| u32::from(a) + u32::from(b);
            let want = core::array::from_fn(|i| {
                let sum = (sum(a[i], b[i]) * weight + sum(c[i], d[i]) * (128 - weight) + 64) / 128;
                sum.saturating_sub(128).min(255) as u8
            });
            prop_assert_eq!(sums.lanes().bytes().to_le_bytes(), want);
            let [start, step] = LaneSums::ends(LaneSums::of([wc, wd]), LaneSums::of([wa, wb]));
            prop_assert_eq!(start.toward(&step, weight).lanes().bytes().to_le_bytes(), want);
            let mut sums = LaneSums::NONE;
            sums.add(wa, weight);
            let want = a.map(|a| ((u32::from(a) * weight + 64) / 128) as u8);
            prop_assert_eq!(sums.within().to_le_bytes(), want);
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
            prop_assert_eq!(sums.within().to_le_bytes(), want);
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
