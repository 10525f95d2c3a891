//! Building a map from its configuration. Every number is checked before it is used. The map is built in
//! place, because the stack of a microcontroller has no room for a second one.

use super::config::{DECIMALS, MapConfig, Rule};
use super::error::MapError;
use super::input::RampEncoder;
use super::map::{CauseOf, Map, MapRow};
use super::transfer::{Gain, Transfer};
use crate::format::{Name, Q15};

impl<const N: usize, const E: usize> Map<N, E> {
    /// Checks `config` and builds its map. Every error names the concept, edge or parameter and its value.
    pub fn build<const C: usize, const D: usize>(config: &MapConfig<C, D>) -> Result<Self, MapError> {
        let mut map = Map::new();
        map.fill(config)?;
        Ok(map)
    }

    /// Replaces this map by that of `config`, like [`Map::build`]; after an error the map is empty.
    pub fn fill<const C: usize, const D: usize>(&mut self, config: &MapConfig<C, D>) -> Result<(), MapError> {
        self.clear();
        let done = self.take(config);
        if done.is_err() {
            self.clear();
        }
        done
    }

    fn clear(&mut self) {
        self.concepts.clear();
        self.rows.clear();
        self.causes.clear();
        self.inputs.clear();
        self.gain = Gain::NONE;
    }

    fn take<const C: usize, const D: usize>(&mut self, config: &MapConfig<C, D>) -> Result<(), MapError> {
        check_scalars(config)?;
        self.set_concepts(&config.concepts)?;
        (self.rule, self.transfer, self.shift) = (config.rule, config.transfer, 0);
        self.step = 10i32.pow(config.decimals.into());
        self.one = if config.transfer.is_threshold() { self.step } else { Q15::ONE.0 };
        self.set_edges(config)?;
        self.set_shift()?;
        self.set_thresholds(config)?;
        self.set_gain(config.lambda);
        self.set_inputs(config)
    }

    fn set_concepts(&mut self, concepts: &[Name]) -> Result<(), MapError> {
        if concepts.is_empty() || self.concepts.extend_from_slice(concepts).is_err() {
            return Err(MapError::Concepts { found: concepts.len(), room: N });
        }
        for (at, concept) in concepts.iter().enumerate() {
            if concepts.iter().take(at).any(|other| other == concept) {
                return Err(MapError::DuplicateConcept { concept: concept.clone() });
            }
        }
        Ok(())
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
            let mut row = MapRow { held: false, bias: 0, causes: 0 };
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

    /// Chooses `shift` so that no partial sum of any row can exceed 32 bits, whatever the state. For
    /// threshold maps a shift would break ties, so a map that needs one is refused.
    fn set_shift(&mut self) -> Result<(), MapError> {
        // |x| <= one, hence |2 x - one| <= 3 one.
        let largest = i64::from(self.one) * if self.rule == Rule::Rescaled { 3 } else { 1 };
        let mut causes = self.causes.iter();
        for (row, concept) in self.rows.iter().zip(&self.concepts) {
            let weights: i64 =
                causes.by_ref().take(row.causes.into()).map(|c| i64::from(c.weight.unsigned_abs())).sum();
            // One step more for y_j itself, and one for the threshold.
            let bound = (weights + 2 * i64::from(self.step)) * largest;
            let fits = |shift: u32| (bound >> shift) + i64::from(row.causes) + 2 <= i64::from(i32::MAX);
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
        // Checked below before use: within -1 ..= 1 the product is at most one * step < 2^29.
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
            let encoder = RampEncoder::build(input, &name, config.decimals, self.one)?;
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
