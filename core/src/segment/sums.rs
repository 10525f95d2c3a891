//! Sums over the taxels of a run, relative to its first column.

use super::bits::WORD;

/// Greatest value of which a word's squares fit in 32 bits: 32 * 11585^2 < 2^32.
pub(crate) const NARROW: u16 = 11585;

/// Sums over taxels of a row; taxel number `i` has the pressure f. For one word, all sums but the squares fit
/// in 32 bits, as 65535 * (1 + 3 + 6 + ... + 528) < 2^32.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RunSums {
    /// sum f
    pub s0: u32,
    /// sum (i + 1) f
    pub s1: u32,
    /// sum (i + 1)(i + 2) / 2 f
    pub s2: u32,
    /// sum f^2 if no f is above [`NARROW`]; else modulo 2^32
    pub squares: u32,
}

impl RunSums {
    /// Sums of no value.
    pub const NONE: RunSums = RunSums { s0: 0, s1: 0, s2: 0, squares: 0 };

    /// Becomes the sums of at most [`WORD`] values; returns the greatest value.
    #[cfg_attr(target_pointer_width = "64", inline)]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // M0+: out of line
    pub fn take(&mut self, values: &[u16]) -> u16 {
        let (mut sums, mut greatest) = (RunSums::NONE, 0);
        for value in values.iter().rev() {
            let value = u32::from(*value);
            if value > greatest {
                greatest = value;
            }
            // Three running sums instead of a multiplication by a coordinate for each taxel.
            sums.s0 = sums.s0.wrapping_add(value);
            sums.s1 = sums.s1.wrapping_add(sums.s0);
            sums.s2 = sums.s2.wrapping_add(sums.s1);
            sums.squares = sums.squares.wrapping_add(value.wrapping_mul(value));
        }
        *self = sums;
        greatest as u16
    }

    /// Becomes the sums of the values whose bit is set, of at most [`WORD`]; bit `i` stands for value `i`.
    /// Returns the greatest of them.
    #[inline(never)] // M0+: out of line
    pub fn take_named(&mut self, values: &[u16], taxels: u32) -> u16 {
        // The highest bit belongs to the value that comes next.
        let mut taxels = taxels << u32::from(WORD).saturating_sub(values.len() as u32);
        let (mut sums, mut greatest) = (RunSums::NONE, 0);
        for value in values.iter().rev() {
            if taxels >> 31 == 1 {
                let value = u32::from(*value);
                sums.s0 = sums.s0.wrapping_add(value);
                sums.squares = sums.squares.wrapping_add(value.wrapping_mul(value));
                if value > greatest {
                    greatest = value;
                }
            }
            taxels <<= 1;
            sums.s1 = sums.s1.wrapping_add(sums.s0);
            sums.s2 = sums.s2.wrapping_add(sums.s1);
        }
        *self = sums;
        greatest as u16
    }
}

/// `sum f^2` of the values whose bit is set, for sums that may exceed 32 bits.
#[cold]
pub(crate) fn squares(values: &[u16], taxels: u32) -> u64 {
    let squares = values.iter().map(|value| u64::from(*value).pow(2));
    squares.enumerate().filter(|(i, _)| taxels >> i & 1 == 1).map(|(_, square)| square).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the definition; values without a bit count as 0.
    #[test]
    fn named_taxels_add_up_as_if_the_others_were_0() {
        let mut state = 5u32;
        let mut next = || {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            state
        };
        for round in 0..3000 {
            let length = 1 + round % usize::from(WORD);
            let peak = [1, 4095, NARROW][round % 3];
            let values: [u16; WORD as usize] =
                core::array::from_fn(|_| if next() >> 31 == 1 { peak } else { (next() >> 16) as u16 % peak });
            let values = &values[..length];
            let taxels = (next() & next() >> 7) & u32::MAX >> (WORD as usize - length);
            let mut counted = [0; WORD as usize];
            for (i, value) in values.iter().enumerate().filter(|(i, _)| taxels >> i & 1 == 1) {
                counted[i] = *value;
            }
            let sum = |weight: &dyn Fn(u32) -> u32| -> u32 {
                (0..).zip(&counted).map(|(i, f)| weight(i) * u32::from(*f)).sum()
            };
            let want = RunSums {
                s0: sum(&|_| 1),
                s1: sum(&|i| i + 1),
                s2: sum(&|i| (i + 1) * (i + 2) / 2),
                squares: counted.iter().map(|f| u32::from(*f).pow(2)).sum(),
            };
            let want = (counted.iter().copied().max().unwrap(), want);
            let mut sums = [RunSums::NONE; 2];
            assert_eq!((sums[0].take_named(values, taxels), sums[0]), want);
            assert_eq!((sums[1].take(&counted[..length]), sums[1]), want);
            assert_eq!(squares(values, taxels), u64::from(want.1.squares));
        }
    }
}
