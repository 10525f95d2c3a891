//! Sums over the taxels of a run, relative to its first column.

#[cfg(test)]
use super::run::WORD;

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
}

/// `sum f^2`, for sums that may exceed 32 bits.
#[cold]
pub(crate) fn squares(values: &[u16]) -> u64 {
    values.iter().map(|value| u64::from(*value).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sums_are_those_of_the_definition() {
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
            let sum = |weight: &dyn Fn(u32) -> u32| -> u32 {
                (0..).zip(values).map(|(i, f)| weight(i) * u32::from(*f)).sum()
            };
            let want = RunSums {
                s0: sum(&|_| 1),
                s1: sum(&|i| i + 1),
                s2: sum(&|i| (i + 1) * (i + 2) / 2),
                squares: values.iter().map(|f| u32::from(*f).pow(2)).sum(),
            };
            let mut sums = RunSums::NONE;
            assert_eq!((sums.take(values), sums), (values.iter().copied().max().unwrap(), want));
            assert_eq!(squares(values), u64::from(want.squares));
        }
    }
}
