//! An expert of a model: the linear classifier of touches from an age on, and its table of confidence.
//!
//! | bytes | what |
//! |---|---|
//! | 2 | age from which it is used, frames |
//! | 2 | number of features it uses |
//! | 2 | number of rows of the table of confidence |
//! | 4 each | offsets of the classes, Q18, signed |
//! | 6 + 2 c each | a feature: index, middle, scale (65,536 / deviation), weights in Q10, signed |
//! | 20 each | a row: age from which it holds, confidence at leads of 0, 1/4 ..= 2, Q15 |

use super::model_error::{CLASSES, ModelError};
use super::state::{FEATURES, Features};
use crate::format::Q15;

/// Greatest distance of a feature from its middle: 2.5 deviations, Q8. Values beyond are clamped.
pub const LIMIT: i32 = 640;

/// Scores of the classes, Q18; 0 for classes that the model does not have.
pub type Scores = [i32; CLASSES];

/// Number of leads in a row of the table of confidence.
pub const LEADS: usize = 9;

/// Distance between two such leads as a power of two, Q18: a quarter.
const STEP: u32 = 16;

/// Bytes of a row.
const ROW: usize = 2 + 2 * LEADS;

/// The first six bytes of an expert.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Head {
    from: u16,
    features: u16,
    rows: u16,
}

impl Head {
    /// Head of a model of version 2, which has one expert and no table of confidence.
    pub fn alone(features: u16) -> Head {
        Head { from: 0, features, rows: 0 }
    }

    /// Splits the head from what follows it.
    pub fn split(bytes: &[u8]) -> Option<(Head, &[u8])> {
        let ([a0, a1, f0, f1, r0, r1], rest) = bytes.split_first_chunk::<6>()?;
        let [from, features, rows] = [[*a0, *a1], [*f0, *f1], [*r0, *r1]].map(u16::from_le_bytes);
        Some((Head { from, features, rows }, rest))
    }
}

/// The linear classifier of touches from an age on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expert<'a> {
    from: u16,
    classes: u8,
    offsets: &'a [u8],
    features: &'a [u8],
    rows: &'a [u8],
}

impl<'a> Expert<'a> {
    /// An expert without classes and features.
    pub(super) const NONE: Expert<'static> =
        Expert { from: 0, classes: 0, offsets: &[], features: &[], rows: &[] };

    /// Splits the parts that the head announces from the bytes that follow.
    pub(super) fn split(head: Head, classes: u8, bytes: &'a [u8]) -> Option<(Expert<'a>, &'a [u8])> {
        let count = usize::from(classes);
        let (offsets, rest) = bytes.split_at_checked(4 * count)?;
        let (features, rest) = rest.split_at_checked(usize::from(head.features) * (6 + 2 * count))?;
        let (rows, rest) = rest.split_at_checked(usize::from(head.rows) * ROW)?;
        Some((Expert { from: head.from, classes, offsets, features, rows }, rest))
    }

    /// Error if features are out of order or if the sum of the weights may overflow.
    pub(super) fn check(&self) -> Result<(), ModelError> {
        let mut next = 0;
        for (place, feature) in self.used().enumerate() {
            if feature.index < next || usize::from(feature.index) >= FEATURES {
                return Err(ModelError::Feature(place, feature.index));
            }
            next = feature.index + 1;
        }
        (0..usize::from(self.classes)).try_for_each(|class| {
            let weights = self.used().filter_map(|feature| feature.weights().nth(class));
            let most: i64 = weights.map(|w| i64::from(w.unsigned_abs()) * i64::from(LIMIT)).sum();
            let offset = self.offset(class).unsigned_abs();
            if most + i64::from(offset) < i64::from(i32::MAX) {
                Ok(())
            } else {
                Err(ModelError::Heavy(class))
            }
        })
    }

    /// Age from which it is used, frames.
    pub fn from(&self) -> u16 {
        self.from
    }

    /// Returns the score of each class for the features of a touch.
    pub fn scores(&self, features: &Features) -> Scores {
        let mut scores: Scores = core::array::from_fn(|class| self.offset(class));
        for used in self.used() {
            let Some(value) = features.get(usize::from(used.index)) else { continue };
            let away = (i32::from(*value) - i32::from(used.middle)).clamp(-0x7fff, 0x7fff);
            let away = ((away * i32::from(used.scale)) >> 8).clamp(-LIMIT, LIMIT);
            for (score, weight) in scores.iter_mut().zip(used.weights()) {
                *score = score.wrapping_add(away * i32::from(weight));
            }
        }
        scores
    }

    /// Returns the confidence of a decision with this lead (Q18) at this age: the share of such touches that
    /// are classified correctly. None if the model has no table.
    pub fn confidence(&self, lead: u32, frames: u32) -> Option<Q15> {
        let rows = || self.rows.chunks_exact(ROW).filter_map(|row| row.split_first_chunk::<2>());
        let old = rows().take_while(|(from, _)| u32::from(u16::from_le_bytes(**from)) <= frames).last();
        let (_, row) = old.or_else(|| rows().next())?;
        let (at, within) = ((lead >> STEP) as usize, ((lead & 0xffff) >> 2) as i32);
        let knot = |place: usize| {
            let pair = row.as_chunks::<2>().0.get(place.min(LEADS - 1));
            pair.map(|pair| i32::from(u16::from_le_bytes(*pair)).min(Q15::ONE.0))
        };
        let (low, high) = (knot(at)?, knot(at + 1)?);
        Some(Q15(low + (((high - low) * within) >> 14)))
    }

    /// Mean and standard deviation of a feature in training; none if it is not used.
    pub fn known(&self, index: usize) -> Option<(u16, u16)> {
        let used = self.used().find(|used| usize::from(used.index) == index)?;
        Some((used.middle, u16::MAX.checked_div(used.scale).unwrap_or(u16::MAX)))
    }

    fn offset(&self, class: usize) -> i32 {
        let bytes = self.offsets.chunks_exact(4).nth(class).and_then(|bytes| bytes.first_chunk());
        bytes.map_or(0, |bytes| i32::from_le_bytes(*bytes))
    }

    fn used(&self) -> impl Iterator<Item = Used<'a>> {
        self.features.chunks_exact(6 + 2 * usize::from(self.classes)).filter_map(|record| {
            let ([i0, i1, m0, m1, s0, s1], weights) = record.split_first_chunk::<6>()?;
            let [index, middle] = [[*i0, *i1], [*m0, *m1]].map(u16::from_le_bytes);
            Some(Used { index, middle, scale: u16::from_le_bytes([*s0, *s1]), weights })
        })
    }
}

/// A feature that the expert uses.
struct Used<'a> {
    index: u16,
    middle: u16,
    scale: u16,
    weights: &'a [u8],
}

impl Used<'_> {
    fn weights(&self) -> impl Iterator<Item = i16> {
        self.weights.as_chunks().0.iter().map(|pair| i16::from_le_bytes(*pair))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::vec::Vec;

    fn rows(ages: &[(u16, [u16; LEADS])]) -> Vec<u8> {
        let numbers = ages.iter().flat_map(|(from, row)| [*from].into_iter().chain(*row));
        numbers.flat_map(u16::to_le_bytes).collect()
    }

    #[test]
    fn confidence_is_that_of_the_age_and_between_two_leads() {
        let early = [8_000, 10_000, 12_000, 12_000, 12_000, 12_000, 12_000, 12_000, 14_000];
        let late = early.map(|confidence| 2 * confidence);
        let rows = rows(&[(4, early), (20, late)]);
        let expert = Expert { rows: &rows, ..Expert::NONE };
        let of = |lead: f64, frames| expert.confidence((lead * 262_144.0) as u32, frames).unwrap().0;
        assert_eq!((of(0.0, 1), of(0.0, 4), of(0.0, 19), of(0.0, 20)), (8_000, 8_000, 8_000, 16_000));
        assert_eq!((of(0.125, 9), of(0.25, 9), of(0.3125, 9)), (9_000, 10_000, 10_500));
        assert_eq!((of(2.0, 9), of(99.0, 9), of(99.0, 999)), (14_000, 14_000, 28_000));
        assert_eq!(Expert::NONE.confidence(0, 9), None);
    }
}
