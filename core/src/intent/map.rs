//! The fuzzy cognitive map: concepts, signed causal edges between them, a rule and a transfer function.
//!
//! z_j = sum_i W\[i\]\[j\] y_i (+ y_j unless the rule is kosko), y = x, or 2 x - 1 for rescaled; then the
//! [`Transfer`] of z_j - T_j is the next activation of concept j. W\[i\]\[j\] in -1 ..= 1 is the causality value of
//! the source's edge i -> j: positive increases, negative decreases. Concepts without an incoming edge (an all-zero
//! column of W) keep their value while `held` is true.
//!
//! [`MapConfig`] is what a message says, in decimal steps; [`Map`] is what inference reads: the causes of each concept one
//! after the other, thresholds folded into a bias, the transfer's gain as one multiplication.

use super::config::{CONCEPTS, DECIMALS, EDGES, MapConfig, Rule};
use super::error::MapError;
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
    /// Number of its causes.
    pub causes: usize,
}

/// One cause of a concept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CauseOf {
    /// Index of the cause.
    pub from: u8,
    /// Weight in steps, not 0.
    pub weight: i16,
}

/// A checked map, ready for inference. States are arrays of `N` numbers of which the first `len()` count, in units
/// of 1 / [`Map::one`].
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
    /// Checks `config` and prepares it. Every error names the concept, edge or parameter and its value.
    pub fn build<const C: usize, const D: usize>(config: &MapConfig<C, D>) -> Result<Self, MapError> {
        check_scalars(config)?;
        let concepts = checked_concepts(&config.concepts)?;
        let step = 10i32.pow(config.decimals.into());
        let one = if config.transfer.is_threshold() { step } else { Q15::ONE.0 };
        let mut map = Map {
            concepts,
            rows: Vec::new(),
            causes: Vec::new(),
            inputs: Vec::new(),
            rule: config.rule,
            transfer: config.transfer,
            gain: Gain::new(0, 1),
            one,
            step,
            shift: 0,
        };
        map.set_edges(config)?;
        map.set_shift()?;
        map.set_thresholds(config)?;
        map.set_gain(config.lambda);
        map.set_inputs(config)?;
        Ok(map)
    }

    /// Number of concepts.
    pub fn len(&self) -> usize {
        self.concepts.len()
    }

    /// Whether the map has no concept. Such a map is refused by `build`.
    pub fn is_empty(&self) -> bool {
        self.concepts.is_empty()
    }

    /// 1.0 of a state: 32768 for smooth maps, 10^decimals for threshold maps, where sums and ties are then exact.
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

    /// A value of a state, which is within +-[`Map::one`], as Q15, rounded to the nearest. Total: beyond that, a smooth map gives
    /// the value as it is, a threshold map its nearer end.
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

    fn set_edges<const C: usize, const D: usize>(
        &mut self,
        config: &MapConfig<C, D>,
    ) -> Result<(), MapError> {
        let name = |index: u8| config.concepts.get(usize::from(index)).cloned();
        for (at, edge) in config.edges.iter().enumerate() {
            let missing =
                |concept| MapError::EdgeConcept { edge: at, concept, concepts: config.concepts.len() };
            let from = name(edge.from).ok_or(missing(edge.from))?;
            let to = name(edge.to).ok_or(missing(edge.to))?;
            if i32::from(edge.weight).abs() > self.step {
                return Err(MapError::Weight { from, to, weight: edge.weight, decimals: config.decimals });
            }
            if config.edges.iter().take(at).any(|e| (e.from, e.to) == (edge.from, edge.to)) {
                return Err(MapError::DuplicateEdge { from, to });
            }
        }
        for to in 0..config.concepts.len() {
            let causes = config.edges.iter().filter(|edge| usize::from(edge.to) == to && edge.weight != 0);
            let mut row = Row { held: false, bias: 0, causes: 0 };
            for edge in causes {
                let room = MapError::Edges { found: config.edges.len(), room: E };
                self.causes.push(CauseOf { from: edge.from, weight: edge.weight }).map_err(|_| room)?;
                row.causes += 1;
            }
            row.held = config.held && row.causes == 0;
            let room = MapError::Concepts { found: config.concepts.len(), room: N };
            self.rows.push(row).map_err(|_| room)?;
        }
        Ok(())
    }

    /// Chooses `shift` so that no partial sum of any row can leave 32 bits, whatever the state. For threshold maps a
    /// shift would break ties, so a map that needs one is refused.
    fn set_shift(&mut self) -> Result<(), MapError> {
        // |x| <= one, hence |2 x - one| <= 3 one.
        let largest = i64::from(self.one) * if self.rule == Rule::Rescaled { 3 } else { 1 };
        let mut causes = self.causes.iter();
        for (row, concept) in self.rows.iter().zip(&self.concepts) {
            let weights: i64 =
                causes.by_ref().take(row.causes).map(|c| i64::from(c.weight.unsigned_abs())).sum();
            // + one step for y_j itself and one for the threshold.
            let bound = (weights + 2 * i64::from(self.step)) * largest;
            let fits = |shift: u32| (bound >> shift) + N as i64 + 2 <= i64::from(i32::MAX);
            while !fits(self.shift) {
                self.shift += 1;
            }
            if self.shift > 0 && self.transfer.is_threshold() {
                return Err(MapError::TooLarge { concept: concept.clone() });
            }
        }
        Ok(())
    }

    fn set_thresholds<const C: usize, const D: usize>(
        &mut self,
        config: &MapConfig<C, D>,
    ) -> Result<(), MapError> {
        let (scale, shift, step, decimals) = (self.one, self.shift, self.step, config.decimals);
        // Checked below before it is used: within -1 ..= 1 the product is at most one * step < 2^29.
        let bias = |value: i16| -(i32::from(value).wrapping_mul(scale) >> shift);
        let outside = |value: i16| i32::from(value).abs() > step;
        if outside(config.threshold) {
            return Err(MapError::Threshold { concept: None, value: config.threshold, decimals });
        }
        self.rows.iter_mut().for_each(|row| row.bias = bias(config.threshold));
        for (at, own) in config.thresholds.iter().enumerate() {
            let missing =
                MapError::ThresholdConcept { concept: own.concept, concepts: config.concepts.len() };
            let name = config.concepts.get(usize::from(own.concept)).ok_or(missing.clone())?.clone();
            if outside(own.value) {
                return Err(MapError::Threshold { concept: Some(name), value: own.value, decimals });
            }
            if config.thresholds.iter().take(at).any(|other| other.concept == own.concept) {
                return Err(MapError::DuplicateThreshold { concept: name });
            }
            self.rows.get_mut(usize::from(own.concept)).ok_or(missing)?.bias = bias(own.value);
        }
        Ok(())
    }

    /// The argument of the table is lambda z in Q26 (half of it for sigmoid); the sum is z in units of
    /// 1 / (one * step >> shift).
    fn set_gain(&mut self, lambda: u16) {
        if self.transfer.is_threshold() {
            return;
        }
        let halves = if self.transfer == Transfer::Sigmoid { 2 } else { 1 };
        let numerator = u64::from(lambda) << (super::transfer::ARGUMENT_BITS + self.shift.min(20));
        let denominator = halves * 1000 * self.one.unsigned_abs() as u64 * self.step.unsigned_abs() as u64;
        self.gain = Gain::new(numerator, denominator);
    }

    fn set_inputs<const C: usize, const D: usize>(
        &mut self,
        config: &MapConfig<C, D>,
    ) -> Result<(), MapError> {
        for (at, input) in config.inputs.iter().enumerate() {
            let name =
                self.concepts.get(usize::from(input.concept)).cloned().ok_or(MapError::InputConcept {
                    input: at,
                    concept: input.concept,
                    concepts: self.concepts.len(),
                })?;
            if self.rows.get(usize::from(input.concept)).is_some_and(|row| row.causes > 0) {
                return Err(MapError::DrivenInput { concept: name });
            }
            let encoder = Encoder::build(input, &name, config.decimals, self.one)?;
            let room = MapError::Inputs { found: config.inputs.len(), room: N };
            self.inputs.push(encoder).map_err(|_| room)?;
        }
        Ok(())
    }
}

fn check_scalars<const C: usize, const D: usize>(config: &MapConfig<C, D>) -> Result<(), MapError> {
    if config.decimals > DECIMALS {
        return Err(MapError::Decimals { found: config.decimals });
    }
    if config.lambda == 0 {
        return Err(MapError::Lambda);
    }
    Ok(())
}

fn checked_concepts<const N: usize, const C: usize>(
    concepts: &Vec<Name, C>,
) -> Result<Vec<Name, N>, MapError> {
    let count = MapError::Concepts { found: concepts.len(), room: N };
    if concepts.is_empty() {
        return Err(count);
    }
    for (at, concept) in concepts.iter().enumerate() {
        if concepts.iter().take(at).any(|other| other == concept) {
            return Err(MapError::DuplicateConcept { concept: concept.clone() });
        }
    }
    Vec::from_slice(concepts).map_err(|_| count)
}
