//! Lesson of a comparison: by how much a knot's mean is off today.

use super::lanes::ZERO;

/// Most comparisons at a knot that count: a correction then moves by an eighth.
pub(super) const MOST_PASSES: u8 = 7;

/// Most that a taxel is seen to differ by, units: beyond it, each correction is at its end.
const FAR: u32 = 2304;
/// log2 of one in [`Lesson::inverse`]: products with [`FAR`] units fit in 32 bits.
const BITS: u32 = 20;

/// `2^16 / 2n`, rounded up, for n comparisons from 1 on: exact for numerators up to `2 * FAR + 8`.
const SHARES: [u16; MOST_PASSES as usize + 1] = [32_768, 16_384, 10_923, 8_192, 6_554, 5_462, 4_682, 4_096];

/// Rule by which a knot's corrections move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lesson {
    /// Unit of the table, counts.
    unit: u32,
    /// `2^20 / unit`, rounded up.
    inverse: u32,
    /// Comparisons of the knot, with this one, and what each counts.
    count: i32,
    share: u32,
}

impl Lesson {
    /// At a knot that was compared so often.
    pub fn of(unit: u16, passes: u8) -> Lesson {
        let unit = u32::from(unit).max(1);
        let share = SHARES.get(usize::from(passes)).copied().unwrap_or(0);
        let inverse = (1u32 << BITS).div_ceil(unit);
        Lesson { unit, inverse, count: 1 + i32::from(passes), share: share.into() }
    }

    /// The correction, see [`ZERO`], of a taxel that feels so many counts where `expected` units are
    /// expected; `was`: the correction so far, 0 for none.
    #[inline(always)]
    pub fn corrected(&self, felt: u16, expected: u8, was: u8) -> u8 {
        let off = self.off(felt, expected);
        let to = match was {
            0 => ZERO as i32 + off,
            was => i32::from(was) + self.nearer(off),
        };
        to.clamp(1, 255) as u8
    }

    /// Returns the felt less the expected pressure, in units, rounded, at most [`FAR`]. M0+: a division takes
    /// longer.
    #[inline(always)]
    fn off(&self, felt: u16, expected: u8) -> i32 {
        let felt = (u32::from(felt) + self.unit / 2).min(FAR * self.unit);
        // At most 2,304 * (2^20 + 128), by less than 2^17 / 2^20 too much: the quotient may be one too much.
        let units = (felt * self.inverse) >> BITS;
        let units = units - u32::from(units * self.unit > felt);
        units as i32 - i32::from(expected)
    }

    /// Change of a correction that is off by `off`: so that it becomes the mean of the comparisons, as long as
    /// these are few.
    #[inline(always)]
    fn nearer(&self, off: i32) -> i32 {
        if self.count == 1 {
            return off;
        }
        let size = ((2 * off.unsigned_abs() + self.count.unsigned_abs()) * self.share) >> 16;
        if off < 0 { -(size as i32) } else { size as i32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The correction by the formula itself.
    fn exact(unit: u16, passes: u8, felt: u16, expected: u8, was: u8) -> u8 {
        let unit = f64::from(unit);
        let off = ((f64::from(felt) + (unit / 2.0).floor()) / unit).floor() - f64::from(expected);
        let (was, count) = if was == 0 { (128.0, 1.0) } else { (f64::from(was), 1.0 + f64::from(passes)) };
        // Halves away from zero.
        let nearer = ((off / count).abs() + 0.5).floor() * off.signum();
        (was + nearer).clamp(1.0, 255.0) as u8
    }

    #[test]
    fn a_correction_becomes_the_mean_of_the_comparisons() {
        let mut noise = 1u32;
        let mut next = || {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            noise >> 8
        };
        for unit in 1..=128 {
            for passes in 0..=MOST_PASSES {
                let lesson = Lesson::of(unit, passes);
                for round in 0..4_000 {
                    // Near what is expected, or anything.
                    let expected = next() as u8;
                    let near = u32::from(unit) * u32::from(expected) + next() % (16 * u32::from(unit));
                    let felt = if round % 2 == 0 { near as u16 } else { (next() >> (next() % 16)) as u16 };
                    let was = if next() % 4 == 0 { 0 } else { next() as u8 };
                    assert_eq!(
                        lesson.corrected(felt, expected, was),
                        exact(unit, passes, felt, expected, was),
                        "{unit} {passes} {felt} {expected} {was}"
                    );
                }
            }
        }
    }
}
