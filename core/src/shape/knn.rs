//! Nearest neighbours among the prototypes of a base.

use super::features::ShapeFeatures;
use crate::format::Q15;
use serde::{Deserialize, Serialize};

/// A class of a base of shapes: 0 is unknown, `i` is the base's name `i - 1`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Class(pub u8);

impl Class {
    /// No class: too far from every prototype.
    pub const UNKNOWN: Class = Class(0);
    /// Rectangle of the built-in base.
    pub const RECTANGLE: Class = Class(1);
    /// Round of the built-in base.
    pub const ROUND: Class = Class(2);
    /// Finger of the built-in base.
    pub const FINGER: Class = Class(3);
}

/// An example of a class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Prototype {
    /// Class that it is an example of.
    pub class: Class,
    /// Features of the example, see [`features`](super::features).
    pub features: ShapeFeatures,
}

/// Greatest number of neighbours that vote.
pub(super) const VOTERS: usize = 9;

/// Returns the majority class of the `k` nearest prototypes (in a tie, that of the nearest), and its
/// confidence: its share of the votes, weighted by nearness. If even the nearest is farther than `reject`,
/// returns unknown, with a confidence that grows with the distance.
pub(super) fn vote(
    prototypes: &[Prototype],
    features: &ShapeFeatures,
    k: usize,
    reject: u32,
) -> (Class, Q15) {
    let limit = reject.saturating_mul(reject);
    let nearest = |limit| match features {
        // No contact that was measured has no kurtosis.
        [_, _, _, 0, ..] => nearest(prototypes, features, k, limit, by_three),
        _ => nearest(prototypes, features, k, limit, by_all),
    };
    // Most touches are near a prototype, so prototypes beyond the limit need not be compared in full.
    let mut found = nearest(limit.saturating_add(1));
    if found.iter().take(k).any(|(_, class)| *class == Class::UNKNOWN) {
        found = nearest(u32::MAX);
    }
    let Some((least, class)) = found.first().copied() else { return (Class::UNKNOWN, Q15(0)) };
    if least > limit {
        return (Class::UNKNOWN, Q15::ratio((least - limit).into(), least.into()));
    }
    if k == 1 {
        return (class, Q15::ONE);
    }
    let voters = || found.iter().take_while(|(_, class)| *class != Class::UNKNOWN);
    let best = voters().fold((Class::UNKNOWN, 0), |best, (_, class)| {
        let votes = voters().filter(|(_, other)| other == class).count();
        if votes > best.1 { (*class, votes) } else { best }
    });
    // 1 / (d + 1/16 of the limit), so that an exact match does not outvote all others.
    let weight = |distance: u32| u64::from(u32::MAX / (distance / 2 + limit / 32).max(1));
    let all = voters().map(|(distance, _)| weight(*distance)).sum();
    let own = voters().filter(|(_, class)| *class == best.0).map(|(distance, _)| weight(*distance)).sum();
    (best.0, Q15::ratio(own, all))
}

/// Returns the `k` nearest prototypes in the order of their squared `distance`, if that is below `limit`; ties
/// go to the first in the base.
fn nearest(
    prototypes: &[Prototype],
    features: &ShapeFeatures,
    k: usize,
    limit: u32,
    distance: impl Fn(u32, &Prototype, &ShapeFeatures) -> Option<u32>,
) -> [(u32, Class); VOTERS] {
    let mut nearest = [(limit, Class::UNKNOWN); VOTERS];
    if k == 1 {
        nearest[0] = closest(prototypes, features, limit, distance);
        return nearest;
    }
    let mut limit = limit;
    for prototype in prototypes {
        let Some(distance) = distance(limit, prototype, features) else { continue };
        let mut carried = (distance, prototype.class);
        for held in nearest.iter_mut().take(k) {
            if carried.0 < held.0 {
                core::mem::swap(held, &mut carried);
            }
            limit = held.0;
        }
    }
    nearest
}

/// Returns the nearest prototype, if its squared distance is below `limit`; ties go to the first in the base.
#[inline(never)] // M0+: out of line
fn closest(
    prototypes: &[Prototype],
    features: &ShapeFeatures,
    limit: u32,
    distance: impl Fn(u32, &Prototype, &ShapeFeatures) -> Option<u32>,
) -> (u32, Class) {
    let mut closest = (limit, Class::UNKNOWN);
    // One by one: two at a time need more registers.
    let mut left = prototypes;
    while let [prototype, rest @ ..] = left {
        left = rest;
        if let Some(distance) = distance(closest.0, prototype, features) {
            closest = (distance, prototype.class);
        }
    }
    closest
}

/// Squared distance by all features, if it is below `limit`. Size and anisotropy come first: they exclude most
/// prototypes.
#[inline(always)]
fn by_all(limit: u32, prototype: &Prototype, features: &ShapeFeatures) -> Option<u32> {
    let [nmi, anisotropy, size, kurtosis, two, four] = *features;
    let [other_nmi, other_anisotropy, other_size, other_kurtosis, other_two, other_four] = prototype.features;
    // Subtracts from the limit instead of adding up, so that nothing overflows.
    let left = below(limit, square(size, other_size))?;
    let left = below(left, square(anisotropy, other_anisotropy))?;
    let left = below(left, square(four, other_four))?;
    let left = below(left, square(kurtosis, other_kurtosis))?;
    let left = below(left, square(two, other_two))?;
    Some(limit - below(left, square(nmi, other_nmi))?)
}

/// Squared distance by NMI, anisotropy and size, if it is below `limit`, for a contact whose moments of the
/// fourth order are not measured.
#[inline(always)]
fn by_three(limit: u32, prototype: &Prototype, features: &ShapeFeatures) -> Option<u32> {
    let [nmi, anisotropy, size, ..] = *features;
    let [other_nmi, other_anisotropy, other_size, ..] = prototype.features;
    let left = below(limit, square(size, other_size))?;
    let left = below(left, square(anisotropy, other_anisotropy))?;
    Some(limit - below(left, square(nmi, other_nmi))?)
}

/// Returns `limit - part` if `part` is below `limit`.
fn below(limit: u32, part: u32) -> Option<u32> {
    (part < limit).then(|| limit - part)
}

/// Squared difference; below 2^32.
fn square(a: i16, b: i16) -> u32 {
    let apart = i32::from(a) - i32::from(b);
    apart.wrapping_mul(apart) as u32
}
