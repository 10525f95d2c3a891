//! The numbers that describe a shape to the k-NN.

use super::nmi::Nmi;
use crate::contact::{Contact, Kurtosis};
use crate::format::Fixed24;

/// Numbers that describe a shape.
pub const FEATURES: usize = 6;

/// NMI by sum of squares, anisotropy, size, kurtosis along, across and mixed; see [`features`].
pub type ShapeFeatures = [i16; FEATURES];

/// Describes a contact, in units that make a step of one feature as telling as a step of another:
///
/// - NMI sqrt(sum f^2 / sum f) with Sheppard's correction, in 1/2048;
/// - anisotropy, in 1/512;
/// - logarithm to base 2 of the area in taxels, in 1/64: what a grid does to a shape depends on how many
///   taxels see it;
/// - the three logarithms of the [`Kurtosis`], in 1/512: they tell corners from round ends.
///
/// None of them follows pressure, place or direction. Total: forms above 16 saturate, no area counts as one
/// taxel, and the anisotropy is held within 0 and 1.
pub fn features(nmi: &Nmi, kurtosis: &Kurtosis, contact: &Contact) -> ShapeFeatures {
    let anisotropy = contact.anisotropy.0.clamp(0, 32768) >> 6;
    let Kurtosis { along, across, mixed } = *kurtosis;
    let [along, across, mixed] = [along, across, mixed].map(|log| log >> 1);
    [form(nmi.s2_sheppard), anisotropy as i16, size(contact.area), along, across, mixed]
}

/// In 1/2048.
fn form(value: Fixed24) -> i16 {
    (value.0 >> 13).min(i16::MAX as u32) as i16
}

/// Logarithm to base 2, in 1/64; a straight line between powers of two, which is 0.09 off at most.
fn size(area: u16) -> i16 {
    let area = u32::from(area.max(1));
    let whole = area.ilog2();
    (whole * 64 + ((area << 6 >> whole) & 63)) as i16
}
