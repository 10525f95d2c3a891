//! The features of a shape for the k-NN.

use super::nmi::Nmi;
use crate::contact::Contact;
use crate::format::Fixed24;

/// Number of features of a shape.
pub const FEATURES: usize = 4;

/// NMI by sum of squares, NMI by peak, anisotropy, size; see [`features`].
pub type ShapeFeatures = [i16; FEATURES];

/// Computes the features of a contact, scaled so that a step of one is as significant as a step of another:
///
/// - NMI sqrt(sum f^2 / sum f) with Sheppard's correction, in 1/8192;
/// - NMI sqrt(peak) with Sheppard's correction, in 1/4096;
/// - anisotropy, in 1/1024;
/// - logarithm to base 2 of the area in taxels, in 1/64: the effect of a grid on a shape depends on the
///   number of taxels.
///
/// None of them depends on pressure, position or direction. Never panics: forms above 4 and 8 saturate, no
/// area counts as one taxel, and the anisotropy is clamped to 0 to 1.
pub fn features(nmi: &Nmi, contact: &Contact) -> ShapeFeatures {
    let anisotropy = contact.anisotropy.0.clamp(0, 32768) >> 5;
    [form(nmi.s2_sheppard, 13), form(nmi.peak_sheppard, 12), anisotropy as i16, size(contact.area)]
}

/// Converts to `bits` fraction bits; saturates.
fn form(value: Fixed24, bits: u32) -> i16 {
    (value.0 >> (24 - bits)).min(i16::MAX as u32) as i16
}

/// Logarithm to base 2, in 1/64; a straight line between powers of two, which is 0.09 off at most.
fn size(area: u16) -> i16 {
    let area = u32::from(area.max(1));
    let whole = area.ilog2();
    (whole * 64 + ((area << 6 >> whole) & 63)) as i16
}
