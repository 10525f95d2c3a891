//! The features of a shape for the k-NN.

use super::nmi::Nmi;
use crate::contact::{Contact, Quartic};
use crate::format::Fixed24;

/// Number of features of a shape.
pub const FEATURES: usize = 6;

/// NMI by sum of squares, anisotropy, size, kurtosis, two and four; see [`features`].
pub type ShapeFeatures = [i16; FEATURES];

/// Computes the features of a contact, scaled so that a step of one is as significant as a step of another:
///
/// - NMI sqrt(sum f^2 / sum f) with Sheppard's correction, in 1/2048;
/// - anisotropy, in 1/512;
/// - logarithm to base 2 of the area in taxels, in 1/64: the effect of a grid on a shape depends on the
///   number of taxels;
/// - the three ratios of the [`Quartic`], in 1/512: they distinguish corners from round ends.
///
/// None of them depends on pressure, position or direction. Never panics: forms above 16 saturate, no area
/// counts as one taxel, and the anisotropy is clamped to 0 to 1.
pub fn features(nmi: &Nmi, quartic: &Quartic, contact: &Contact) -> ShapeFeatures {
    let anisotropy = contact.anisotropy.0.clamp(0, 32768) >> 6;
    let Quartic { kurtosis, two, four } = *quartic;
    [form(nmi.s2_sheppard), anisotropy as i16, size(contact.area), kurtosis, two, four]
}

/// Returns the value in 1/2048.
fn form(value: Fixed24) -> i16 {
    (value.0 >> 13).min(i16::MAX as u32) as i16
}

/// Logarithm to base 2, in 1/64; a straight line between powers of two, which is 0.09 off at most.
fn size(area: u16) -> i16 {
    let area = u32::from(area.max(1));
    let whole = area.ilog2();
    (whole * 64 + ((area << 6 >> whole) & 63)) as i16
}
