//! The reason for an activation: what each cause contributed to its sum.

use super::config::Rule;
use super::map::Map;
use crate::format::Q15;
use heapless::Vec;

/// What one cause contributed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Index of the cause; the concept itself under the rules mkosko and rescaled.
    pub from: u8,
    /// weight * y, rounded to the nearest 2^-15.
    pub value: Q15,
}

/// Why a concept has the activation it is given by a state: `sum` = the parts - `threshold`, exactly as listed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Why<const N: usize> {
    /// Index of the concept.
    pub concept: u8,
    /// One part for each incoming edge (and for itself, unless the rule is kosko), in the order of the concepts.
    pub parts: Vec<Part, N>,
    /// T of this concept.
    pub threshold: Q15,
    /// The argument of the transfer function, before lambda.
    pub sum: Q15,
}

impl<const N: usize> Map<N> {
    /// The contributions to `concept` in `state`; none where there is no such concept or it keeps its value.
    /// Total. A few divisions: for the moment of an announcement, not for each frame.
    pub fn why(&self, state: &[i32; N], concept: usize) -> Option<Why<N>> {
        let row = self.rows.get(concept).filter(|row| concept < self.len() && !row.held)?;
        let mut why = Why { concept: concept as u8, parts: Vec::new(), threshold: Q15(0), sum: Q15(0) };
        for (from, (weight, x)) in row.weights.iter().zip(state).enumerate().take(self.len()) {
            let own = if from == concept && self.rule != Rule::Kosko { self.step } else { 0 };
            let weight = i32::from(*weight) + own;
            if weight == 0 {
                continue;
            }
            let x = (*x).max(-self.one).min(self.one);
            let y = if self.rule == Rule::Rescaled { 2 * x - self.one } else { x };
            let value = self.product_q15(i64::from(weight) * i64::from(y));
            why.sum = Q15(why.sum.0.saturating_add(value.0));
            // There are at most N parts: one for each concept.
            let _ = why.parts.push(Part { from: from as u8, value });
        }
        why.threshold = self.product_q15(-(i64::from(row.bias) << self.shift));
        why.sum = Q15(why.sum.0.saturating_sub(why.threshold.0));
        Some(why)
    }

    /// A product of a weight (steps) and an activation (1 / one) as Q15, rounded to the nearest, halves away from 0.
    fn product_q15(&self, product: i64) -> Q15 {
        let unit = u64::from(self.one.unsigned_abs()) * u64::from(self.step.unsigned_abs());
        let scaled = product.unsigned_abs() << 15; // |product| <= 2^15 * 3 * 2^15: 47 bits with the shift
        let size = (scaled + unit / 2).checked_div(unit).unwrap_or(0);
        let size = i32::try_from(size).unwrap_or(i32::MAX);
        Q15(if product < 0 { -size } else { size })
    }
}
