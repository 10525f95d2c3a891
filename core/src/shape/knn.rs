//! Nearest neighbours among the prototypes of a base.

use super::features::Features;
use crate::format::{Name, Q15};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Most classes of a base.
pub const CLASSES: usize = 8;

/// A class of a base of shapes: 0 is unknown, `i` is the base's name `i - 1`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Class(pub u8);

impl Class {
    /// Too far from every prototype.
    pub const UNKNOWN: Class = Class(0);
    /// Of the built-in base.
    pub const RECTANGLE: Class = Class(1);
    /// Of the built-in base.
    pub const ROUND: Class = Class(2);
    /// Of the built-in base.
    pub const FINGER: Class = Class(3);
}

/// An example of a class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prototype {
    /// What it is an example of.
    pub class: Class,
    /// Its features, see [`features`](super::features).
    pub features: Features,
}

/// A base of shapes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Base<const PROTOTYPES: usize> {
    /// Names of the classes, from 1.
    pub names: Vec<Name, CLASSES>,
    /// Examples; those that go before win a tie.
    pub prototypes: Vec<Prototype, PROTOTYPES>,
}

impl<const PROTOTYPES: usize> Base<PROTOTYPES> {
    /// Name of a class; "unknown" for none of this base.
    pub fn name(&self, class: Class) -> &str {
        let index = usize::from(class.0).checked_sub(1);
        index.and_then(|index| self.names.get(index)).map_or("unknown", Name::as_str)
    }
}

/// Most neighbours that vote.
pub(super) const VOTERS: usize = 9;

/// The class of the majority of the `k` nearest prototypes (of equals, the one with the nearest), and its
/// confidence: its share of the votes, each weighed by how near it is. Unknown, with the confidence of that,
/// if even the nearest is farther than `reject`.
pub(super) fn vote(prototypes: &[Prototype], features: &Features, k: usize, reject: u32) -> (Class, Q15) {
    let limit = reject.saturating_mul(reject);
    // Most touches are like something: what is farther need not be compared in full.
    let mut nearest = nearest(prototypes, features, k, limit.saturating_add(1));
    if nearest.iter().take(k).any(|(_, class)| *class == Class::UNKNOWN) {
        nearest = self::nearest(prototypes, features, k, u32::MAX);
    }
    let Some((least, class)) = nearest.first().copied() else { return (Class::UNKNOWN, Q15(0)) };
    if least > limit {
        return (Class::UNKNOWN, Q15::ratio((least - limit).into(), least.into()));
    }
    if k == 1 {
        return (class, Q15::ONE);
    }
    let voters = || nearest.iter().take_while(|(_, class)| *class != Class::UNKNOWN);
    let best = voters().fold((Class::UNKNOWN, 0), |best, (_, class)| {
        let votes = voters().filter(|(_, other)| other == class).count();
        if votes > best.1 { (*class, votes) } else { best }
    });
    // 1 / (d + 1/16 of the limit): a hit does not outvote everything.
    let weight = |distance: u32| u64::from(u32::MAX / (distance / 2 + limit / 32).max(1));
    let all = voters().map(|(distance, _)| weight(*distance)).sum();
    let own = voters().filter(|(_, class)| *class == best.0).map(|(distance, _)| weight(*distance)).sum();
    (best.0, Q15::ratio(own, all))
}

/// The `k` nearest prototypes in the order of their squared distance, if that is below a limit; of equals the
/// first in the base.
fn nearest(prototypes: &[Prototype], features: &Features, k: usize, limit: u32) -> [(u32, Class); VOTERS] {
    let mut nearest = [(limit, Class::UNKNOWN); VOTERS];
    if k == 1 {
        nearest[0] = closest(prototypes, features, limit);
        return nearest;
    }
    let mut limit = limit;
    for prototype in prototypes {
        let Some(distance) = distance_below(limit, prototype, features) else { continue };
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

/// The nearest prototype, if its squared distance is below a limit; of equals the first in the base.
#[inline(never)] // M0+: out of line
fn closest(prototypes: &[Prototype], features: &Features, limit: u32) -> (u32, Class) {
    let mut closest = (limit, Class::UNKNOWN);
    // One by one: two at a time want more registers.
    let mut left = prototypes;
    while let [prototype, rest @ ..] = left {
        left = rest;
        if let Some(distance) = distance_below(closest.0, prototype, features) {
            closest = (distance, prototype.class);
        }
    }
    closest
}

/// The squared distance if it is below a limit; most prototypes are told apart by size and anisotropy.
fn distance_below(limit: u32, prototype: &Prototype, features: &Features) -> Option<u32> {
    let [nmi, form, anisotropy, size] = *features;
    let [other_nmi, other_form, other_anisotropy, other_size] = prototype.features;
    // What is left of the limit: no sum can pass the end of a word.
    let left = below(limit, square(size, other_size))?;
    let left = below(left, square(anisotropy, other_anisotropy))?;
    let left = below(left, square(nmi, other_nmi))?;
    Some(limit - below(left, square(form, other_form))?)
}

/// What a part leaves of a limit that it is below.
fn below(limit: u32, part: u32) -> Option<u32> {
    (part < limit).then(|| limit - part)
}

/// How far apart two numbers are, squared: below 2^32.
fn square(a: i16, b: i16) -> u32 {
    let apart = i32::from(a) - i32::from(b);
    apart.wrapping_mul(apart) as u32
}
