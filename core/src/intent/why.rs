//! Explanation of an activation: the contribution of each cause to its sum.

use super::config::Rule;
use super::map::Map;
use crate::format::Q15;
use heapless::Vec;

/// Contribution of one cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contribution {
    /// Index of the cause; the concept itself under the rules mkosko and rescaled.
    pub from: u8,
    /// weight * y, rounded to the nearest 2^-15.
    pub value: Q15,
}

/// Explanation of a concept's activation in a state: `sum` = the parts - `threshold`, exactly as listed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Why<const N: usize> {
    /// Index of the concept.
    pub concept: u8,
    /// One part for each incoming edge, in the order of the map; then one for the concept itself, unless the
    /// rule is kosko (an edge from the concept to itself is included in that part).
    pub parts: Vec<Contribution, N>,
    /// T of this concept.
    pub threshold: Q15,
    /// The argument of the transfer function, before lambda.
    pub sum: Q15,
}

impl<const N: usize, const E: usize> Map<N, E> {
    /// Returns the contributions to `concept` in `state`; none if there is no such concept or if it keeps its
    /// value. Never panics. Needs a few divisions: use it for an announcement, not for each frame.
    pub fn why(&self, state: &[i32; N], concept: usize) -> Option<Why<N>> {
        let row = self.rows.get(concept).filter(|row| concept < self.len() && !row.held)?;
        let before = self.rows.iter().take(concept).map(|row| usize::from(row.causes)).sum();
        let own = if self.rule == Rule::Kosko { 0 } else { self.step };
        let mut why = Why { concept: concept as u8, parts: Vec::new(), threshold: Q15(0), sum: Q15(0) };
        let mut itself = own;
        for cause in self.causes.iter().skip(before).take(row.causes.into()) {
            if own != 0 && usize::from(cause.from) == concept {
                itself += i32::from(cause.weight);
            } else {
                self.add(&mut why, cause.from, cause.weight.into(), state);
            }
        }
        if itself != 0 {
            self.add(&mut why, concept as u8, itself, state);
        }
        why.threshold = self.product_q15(-(i64::from(row.bias) << self.shift));
        why.sum = Q15(why.sum.0.saturating_sub(why.threshold.0));
        Some(why)
    }

    /// Adds the part of one cause.
    fn add(&self, why: &mut Why<N>, from: u8, weight: i32, state: &[i32; N]) {
        let x = state.get(usize::from(from)).copied().unwrap_or(0).max(-self.one).min(self.one);
        let y = if self.rule == Rule::Rescaled { 2 * x - self.one } else { x };
        let value = self.product_q15(i64::from(weight) * i64::from(y));
        why.sum = Q15(why.sum.0.saturating_add(value.0));
        // Always room: at most N parts, one for each concept.
        let _ = why.parts.push(Contribution { from, value });
    }

    /// Returns the product of a weight (steps) and an activation (1 / one) as Q15, rounded to the nearest,
    /// halves away from 0.
    fn product_q15(&self, product: i64) -> Q15 {
        let unit = u64::from(self.one.unsigned_abs()) * u64::from(self.step.unsigned_abs());
        let scaled = product.unsigned_abs() << 15; // |product| <= 2^15 * 3 * 2^15: 47 bits with the shift
        let size = (scaled + unit / 2).checked_div(unit).unwrap_or(0);
        let size = i32::try_from(size).unwrap_or(i32::MAX);
        Q15(if product < 0 { -size } else { size })
    }
}
