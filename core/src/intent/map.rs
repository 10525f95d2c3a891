//! The fuzzy cognitive map: concepts, signed causal edges between them, a rule and a transfer function.
//!
//! z_j = sum_i W\[i\]\[j\] y_i (+ y_j unless the rule is kosko), y = x, or 2 x - 1 for rescaled; then the
//! [`Transfer`] of z_j - T_j is the next activation of concept j. W\[i\]\[j\] in -1 ..= 1 is the causality
//! value of the source's edge i -> j: positive increases, negative decreases. Concepts without an incoming
//! edge (an all-zero column of W) keep their value while `held` is true.
//!
//! [`MapConfig`](super::MapConfig) is what a message says, in decimal steps; [`Map`] is what inference reads:
//! the causes of each concept one after the other, thresholds folded into a bias, the transfer's gain as one
//! multiplication.

use super::config::{CONCEPTS, EDGES, Rule};
use super::input::{Encoder, Source};
use super::transfer::{Gain, Transfer};
use crate::format::{Name, Q15};
use heapless::Vec;

/// All that inference needs to know of one concept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    /// Keeps its value.
    pub held: bool,
    /// -T in the unit of the sum.
    pub bias: i32,
    /// Number of its causes: one for each concept at most.
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

/// A checked map, ready for inference. States are arrays of `N` numbers of which the first `len()` count, in
/// units of 1 / [`Map::one`].
#[derive(Debug, Clone)]
pub struct Map<const N: usize = CONCEPTS, const E: usize = EDGES> {
    pub(crate) concepts: Vec<Name, N>,
    pub(crate) rows: Vec<Row, N>,
    /// The causes of the first concept, then those of the second, and so on.
    pub(crate) causes: Vec<CauseOf, E>,
    pub(crate) inputs: Vec<Encoder, N>,
    pub(crate) rule: Rule,
    pub(crate) transfer: Transfer,
    pub(crate) gain: Gain,
    /// 1.0 of a state.
    pub(crate) one: i32,
    /// 1.0 of a weight: 10^decimals.
    pub(crate) step: i32,
    /// Products are shifted right by this so that the sum fits 32 bits; 0 wherever weights have few decimals.
    pub(crate) shift: u32,
}

impl<const N: usize, const E: usize> Map<N, E> {
    /// A map without a concept, to be filled.
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

    /// Whether the map has no concept: it was not filled, or what it was to be filled with was refused.
    pub fn is_empty(&self) -> bool {
        self.concepts.is_empty()
    }

    /// 1.0 of a state: 32768 for smooth maps, 10^decimals for threshold maps, where sums and ties are then
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

    /// The slot that feeds a concept; none if the host does not feed it.
    pub fn slot(&self, concept: &str) -> Option<u8> {
        let at = self.find(concept)?;
        self.inputs.iter().filter(|input| usize::from(input.concept) == at).find_map(|input| {
            match input.source {
                Source::Host(slot) => Some(slot),
                _ => None,
            }
        })
    }

    /// A value of a state, which is within +-[`Map::one`], as Q15, rounded to the nearest. Total: beyond
    /// that, a smooth map gives the value as it is, a threshold map its nearer end.
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
