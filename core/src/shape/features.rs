//! The numbers that describe a shape to the k-NN.

use super::nmi::Nmi;
use crate::contact::Contact;
use crate::format::Fixed24;

/// Numbers that describe a shape.
pub const FEATURES: usize = 4;

/// NMI by sum of squares, NMI by peak, anisotropy, size; see [`features`].
pub type Features = [i16; FEATURES];

/// Describes a contact, in units that make a step of one feature as telling as a step of another:
///
/// - NMI sqrt(sum f^2 / sum f) with Sheppard's correction, in 1/4096;
/// - NMI sqrt(peak) with Sheppard's correction, in 1/2048;
/// - anisotropy, in 1/1024;
/// - logarithm to base 2 of the area in taxels, in 1/64: what a grid does to a shape depends on how many
///   taxels see it.
///
/// None of them follows pressure, place or direction. Total: forms above 8 and 16 saturate, no area counts as
/// one taxel, and the anisotropy is held within 0 and 1.
pub fn features(nmi: &Nmi, contact: &Contact) -> Features {
    let anisotropy = contact.anisotropy.0.clamp(0, 32768) >> 5;
    [form(nmi.s2_sheppard, 12), form(nmi.peak_sheppard, 11), anisotropy as i16, size(contact.area)]
}

/// With so many fraction bits.
fn form(value: Fixed24, bits: u32) -> i16 {
    (value.0 >> (24 - bits)).min(i16::MAX as u32) as i16
}

/// Logarithm to base 2, in 1/64; a straight line between powers of two, which is 0.09 off at most.
fn size(area: u16) -> i16 {
    let area = u32::from(area.max(1));
    let whole = area.ilog2();
    (whole * 64 + ((area << 6 >> whole) & 63)) as i16
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Fixed24, form, size};

    #[test]
    fn size_is_exact_at_powers_of_two_and_straight_between() {
        let sizes = [(0, 0), (1, 0), (2, 64), (3, 96), (4, 128), (5, 144), (6, 160), (7, 176), (12, 224)];
        for (area, expected) in sizes {
            assert_eq!(size(area), expected, "{area} taxels");
        }
        assert_eq!(size(u16::MAX), 1023);
        // log2(1 + x) - x is 0.0861 at most, where x = 1 / ln 2 - 1; a step is cut.
        for area in 1..=u16::MAX {
            let below = f64::from(area).log2() * 64.0 - f64::from(size(area));
            assert!((0.0..0.0861 * 64.0 + 1.0).contains(&below), "{area}: {below}");
        }
    }

    #[test]
    fn forms_are_cut_to_their_steps_and_saturate() {
        // A disc of even pressure: 1 / sqrt(2 pi) = 0.39894.
        assert_eq!((form(Fixed24(6_693_141), 12), form(Fixed24(6_693_141), 11)), (1634, 817));
        assert_eq!(
            (form(Fixed24(0), 12), form(Fixed24((1 << 12) - 1), 12), form(Fixed24(1 << 12), 12)),
            (0, 0, 1)
        );
        assert_eq!((form(Fixed24(u32::MAX), 12), form(Fixed24(8 << 24), 12)), (i16::MAX, i16::MAX));
        assert_eq!(form(Fixed24(16 << 24), 11), i16::MAX);
    }
}
