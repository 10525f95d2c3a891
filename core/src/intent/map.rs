//! The fuzzy cognitive map: concepts, signed causal edges between them, a rule and a transfer function.
//!
//! z_j = sum_i W\[i\]\[j\] y_i (+ y_j unless the rule is kosko), y = x, or 2 x - 1 for rescaled; then the
//! [`Transfer`] of z_j - T_j is the next activation of concept j. W\[i\]\[j\] in -1 ..= 1 is the causality
//! value of the source's edge i -> j: positive increases, negative decreases. Concepts without an incoming
//! edge (an all-zero column of W) keep their value while `held` is true.
//!
//! [`MapConfig`](super::MapConfig) is the form of a message, in decimal steps. [`Map`] is the form for
//! inference: the causes of each concept one after the other, thresholds folded into a bias, the transfer's
//! gain as one multiplication.

use super::config::{CONCEPTS, EDGES, Rule};
use super::input::{RampEncoder, Source};
use super::transfer::{Gain, Transfer};
use crate::format::{Name, Q15};
use heapless::Vec;

/// A concept as inference needs it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MapRow {
    /// True if it keeps its value.
    pub held: bool,
    /// -T in the unit of the sum.
    pub bias: i32,
    /// Number of its causes, at most one per concept.
    pub causes: u16,
}

/// One cause of a concept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CauseOf {
    /// Index of the cause.
    pub from: u8,
    /// Weight in steps, not 0.
    pub weight: i16,
}

/// A checked map, ready for inference. States are arrays of `N` numbers in units of 1 / [`Map::one`], of
/// which the first `len()` count.
#[derive(Debug, Clone)]
pub struct Map<const N: usize = CONCEPTS, const E: usize = EDGES> {
    pub(crate) concepts: Vec<Name, N>,
    pub(crate) rows: Vec<MapRow, N>,
    /// The causes of the first concept, then those of the second, and so on.
    pub(crate) causes: Vec<CauseOf, E>,
    pub(crate) inputs: Vec<RampEncoder, N>,
    pub(crate) rule: Rule,
    pub(crate) transfer: Transfer,
    pub(crate) gain: Gain,
    /// 1.0 of a state.
    pub(crate) one: i32,
    /// 1.0 of a weight: 10^decimals.
    pub(crate) step: i32,
    /// Right shift of products so that sums fit in 32 bits; 0 if the weights have few decimals.
    pub(crate) shift: u32,
}

impl<const N: usize, const E: usize> Map<N, E> {
    /// A map without concepts, to be filled.
    pub const fn new() -> Self {
        Map {
            concepts: Vec::new(),
            rows: Vec::new(),
            causes: Vec::new(),
            inputs: Vec::new(),
            rule: Rule::Kosko,
            transfer: Transfer::Tanh,
            gain: Gain::NONE,
            one: Q15::ONE.0,
            step: 1,
            shift: 0,
        }
    }

    /// Number of concepts.
    pub fn len(&self) -> usize {
        self.concepts.len()
    }

    /// True if the map has no concept: it was not filled, or its configuration was refused.
    pub fn is_empty(&self) -> bool {
        self.concepts.is_empty()
    }

    /// 1.0 of a state: 32768 for smooth maps; 10^decimals for threshold maps, whose sums and ties are then
    /// exact.
    pub fn one(&self) -> i32 {
        self.one
    }

    /// Names of the concepts in the order of every state.
    pub fn concepts(&self) -> &[Name] {
        &self.concepts
    }

    /// Index of a concept by its name.
    pub fn find(&self, concept: &str) -> Option<usize> {
        self.concepts.iter().position(|name| name == concept)
    }

    /// Slot that feeds a concept; none if the host does not feed it.
    pub fn slot(&self, concept: &str) -> Option<u8> {
        let at = self.find(concept)?;
        self.inputs.iter().filter(|input| usize::from(input.concept) == at).find_map(|input| {
            match input.source {
                Source::Host(slot) => Some(slot),
                _ => None,
            }
        })
    }

    /// Returns a value of a state as Q15, rounded to the nearest; values are within +-[`Map::one`]. Never
    /// panics: beyond that range, a smooth map returns the value unchanged, a threshold map clamps it.
    pub fn q15(&self, value: i32) -> Q15 {
        match core::num::NonZeroU32::new(self.one.unsigned_abs()) {
            Some(one) if self.one != Q15::ONE.0 => {
                // |value| <= 10^4 < 2^14: the product fits; magnitudes, because unsigned division cannot fail.
                let size = value.unsigned_abs().min(one.get());
                let q = ((size << 15) + one.get() / 2) / one;
                Q15(if value < 0 { -(q as i32) } else { q as i32 })
            }
            _ => Q15(value),
        }
    }
}

impl<const N: usize, const E: usize> Default for Map<N, E> {
    fn default() -> Self {
        Map::new()
    }
}
