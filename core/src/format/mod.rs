//! The table of number formats: every quantity of the per-frame path, its type, unit, range and resolution.
//!
//! | quantity | type | unit | range | resolution |
//! |---|---|---|---|---|
//! | raw code of the converter | [`Code`] | count | 0 ..= 65535 (12 bit: 4095) | 1 |
//! | conditioned pressure of a taxel | `u16` | count above the baseline | 0 ..= 65535 | 1 |
//! | time | [`Micros`] | us since the board started | 0 ..= 2^64 - 1 | 1 us |
//! | position, length on a panel | [`Fixed16`] | taxel | -32768 ..< 32768 | 2^-16 taxel |
//! | velocity | [`Fixed16`] | taxel/s | -32768 ..< 32768 | 2^-16 taxel/s |
//! | angle | [`Turn`] | turn | -1/2 ..< 1/2 | 2^-32 turn (1.5e-9 rad) |
//! | NMI and its forms | [`Fixed24`] | see `shape::nmi` | 0 ..< 256 | 2^-24 (6.0e-8) |
//! | temperature | [`Celsius`] | degree | -327.68 ..= 327.67 | 0.01 degrees |
//! | activation, share, anisotropy | [`Q15`] | 1 | -1 ..= 1 (any `i32` in sums) | 2^-15 (3.1e-5) |
//!
//! The largest errors of the core's results are in `docs/evidence/bounds.md`, each with its
//! test. No function of this folder can fail: each doc gives the result outside the function's range.
//!
//! Floats appear only in the `to_f64` and `to_radians` conversions of this folder, which are for hosts, tests
//! and set-up code; no function of the per-frame path calls them.

mod crc32;
mod extremes;
mod invalid;
mod inverse;
mod log2;
mod machine;
mod product;
mod root;
mod scaled;
mod shift;
mod stored_name;

pub use crc32::crc32;
pub(crate) use extremes::Extremes;
pub use invalid::{Invalid, InvalidRow, LEFT_OUT};
pub use inverse::Inverse;
pub use log2::log2;
pub(crate) use machine::WIDE;
pub(crate) use product::{product, signed_wide, wide};
pub use root::root;
pub use scaled::Scaled;
pub(crate) use shift::{left, right};
pub(crate) use stored_name::{STORED_NAME, store_name, stored_name};

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

/// A short UTF-8 name: of a panel, a link, a region, a concept, a reaction.
pub type Name = heapless::String<16>;

/// Makes a [`Name`], truncated after the last whole character that fits into 16 bytes.
pub fn name(text: &str) -> Name {
    let mut out = Name::new();
    for c in text.chars() {
        if out.push(c).is_err() {
            break;
        }
    }
    out
}

/// A raw code of the analog-to-digital converter, as read: 12 bits on the reference board.
#[derive(
    Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, Pod, Zeroable,
)]
#[serde(transparent)]
#[repr(transparent)] // DMA writes it
pub struct Code(pub u16);

/// Time of the board's clock since its start, us, 64 bits: it does not wrap within a robot's life.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Micros(pub u64);

impl Micros {
    /// Time from `earlier` to `self` in microseconds; 0 if `earlier` is later.
    pub const fn since(self, earlier: Micros) -> u64 {
        self.0.saturating_sub(earlier.0)
    }

    /// Time from `earlier` to `self` in milliseconds, rounded down, at most `u32::MAX`.
    pub const fn millis_since(self, earlier: Micros) -> u32 {
        Inverse::of(1000).quotient(self.since(earlier))
    }
}

/// A temperature in hundredths of a degree.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Celsius(pub i16);

impl Celsius {
    /// Converts to degrees.
    pub fn to_f64(self) -> f64 {
        f64::from(self.0) / 100.0
    }
}

/// Signed Q16.16: a position, length or velocity in taxels (per second).
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fixed16(pub i32);

impl Fixed16 {
    /// One taxel.
    pub const ONE: Fixed16 = Fixed16(1 << 16);

    /// Converts a wide value in units of 2^-16, saturating.
    pub const fn saturating(raw: i64) -> Fixed16 {
        if raw > i32::MAX as i64 {
            Fixed16(i32::MAX)
        } else if raw < i32::MIN as i64 {
            Fixed16(i32::MIN)
        } else {
            Fixed16(raw as i32)
        }
    }

    /// Converts to a float, exactly.
    pub fn to_f64(self) -> f64 {
        f64::from(self.0) / 65536.0
    }
}

/// Unsigned Q8.24: an NMI or one of its pressure-invariant forms.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fixed24(pub u32);

impl Fixed24 {
    /// Converts to a float, exactly.
    pub fn to_f64(self) -> f64 {
        f64::from(self.0) / 16_777_216.0
    }
}

/// An angle in units of 2^-32 turn: wrapping arithmetic is arithmetic modulo one turn.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Turn(pub i32);

impl Turn {
    /// Converts to radians, in [-pi, pi).
    pub fn to_radians(self) -> f64 {
        f64::from(self.0) * (core::f64::consts::PI / 2_147_483_648.0)
    }
}

/// Q15 in an `i32`: 1.0 is 32768 exactly. Activations, vote shares, ratios.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Q15(pub i32);

impl Q15 {
    /// 1.0
    pub const ONE: Q15 = Q15(32768);

    /// Converts to a float, exactly.
    pub fn to_f64(self) -> f64 {
        f64::from(self.0) / 32768.0
    }

    /// `part / whole` rounded to the nearest, at most half a step and 1e-9 off; 1 if `part >= whole`, 0 if
    /// `whole` is 0.
    pub const fn ratio(part: u64, whole: u64) -> Q15 {
        if whole == 0 {
            return Q15(0);
        }
        if part >= whole {
            return Q15::ONE;
        }
        // Shift both so that `whole` fits in 31 bits: at most one unit in 2^30 is lost, far below half a step.
        let shift = if whole >> 31 == 0 { 0 } else { 33 - whole.leading_zeros() };
        Q15(share((part >> shift) as u32, (whole >> shift) as u32) as i32)
    }
}

/// `2^15 part / whole` rounded to the nearest, for `part <= whole < 2^31`, bit by bit: half the cost of an
/// [`Inverse`] for so few bits.
const fn share(part: u32, whole: u32) -> u32 {
    let (mut rest, mut quotient, mut digit) = (part, 0, 0);
    while digit < 15 {
        (rest, quotient) = (rest << 1, quotient << 1);
        if rest >= whole {
            (rest, quotient) = (rest - whole, quotient + 1);
        }
        digit += 1;
    }
    if rest >= whole - whole / 2 { quotient + 1 } else { quotient }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_true() {
        assert_eq!(Fixed16::ONE.to_f64(), 1.0);
        assert_eq!(Fixed16(1).to_f64(), 2f64.powi(-16));
        assert_eq!(Fixed16(i32::MIN).to_f64(), -32768.0);
        assert!((Turn(1).to_radians() - 1.5e-9).abs() < 0.05e-9);
        assert_eq!(Turn(i32::MIN).to_radians(), -core::f64::consts::PI);
        assert!((Fixed24(1).to_f64() - 6.0e-8).abs() < 0.05e-8);
        assert!(Fixed24(u32::MAX).to_f64() < 256.0);
        assert!((Q15(1).to_f64() - 3.1e-5).abs() < 0.05e-5);
        assert_eq!(Q15::ONE.to_f64(), 1.0);
        assert_eq!((Celsius(i16::MIN).to_f64(), Celsius(1).to_f64()), (-327.68, 0.01));
    }

    #[test]
    fn ratio_is_rounded_to_nearest_and_total() {
        assert_eq!(Q15::ratio(1, 0), Q15(0));
        assert_eq!(Q15::ratio(5, 4), Q15::ONE);
        assert_eq!(Q15::ratio(1, 3), Q15(10923));
        assert_eq!(Q15::ratio(u64::MAX - 1, u64::MAX), Q15(32768));
        assert_eq!(Q15::ratio(u64::MAX / 2, u64::MAX), Q15(16384));
    }

    #[test]
    fn names_are_cut_at_a_whole_character() {
        assert_eq!(name("abc").as_str(), "abc");
        assert_eq!(name("ääääääääää").as_str(), "ääääääää");
    }
}
