//! A map file in the arithmetic of the board.

use super::decimal::Decimal;
use super::engine::{Q15_CONCEPTS, Q15_EDGES};
use super::map::MapFile;
use crate::error::{Context, Result};
use taxel_core::intent::{Inference, Map, Rule, Transfer};

/// The core's map, with room for more concepts than the board has.
pub type HostMap = Map<Q15_CONCEPTS, Q15_EDGES>;
/// A state of the map.
pub type MapState = [i32; Q15_CONCEPTS];

/// Steps after which a map that still moves counts as unsettled.
pub const STEPS: u16 = 1000;

/// A map file in the arithmetic of the board.
pub struct BoardMap {
    /// The core's map.
    pub map: Box<HostMap>,
    /// Rule of the sum.
    pub rule: Rule,
    /// Transfer function of the sum.
    pub transfer: Transfer,
}

impl BoardMap {
    /// Builds the core's map. Errors name the map.
    pub fn build(file: &MapFile) -> Result<BoardMap> {
        let config = file.to_config::<Q15_CONCEPTS, Q15_EDGES>()?;
        let map = Map::build(&*config).with_context(|| format!("map {}", file.name))?;
        Ok(BoardMap { map: Box::new(map), rule: file.rule, transfer: file.transfer })
    }

    /// State with these activations, by concept number; all others 0.
    pub fn state(&self, activations: impl IntoIterator<Item = (usize, Decimal)>) -> MapState {
        let mut state = [0; Q15_CONCEPTS];
        for (concept, value) in activations {
            if let Some(slot) = state.get_mut(concept) {
                *slot = value.scaled(self.map.one().into()) as i32;
            }
        }
        state
    }

    /// Runs until the map settles, for at most [`STEPS`] steps.
    pub fn infer(&self, start: &MapState) -> Inference<Q15_CONCEPTS> {
        self.map.infer(start, STEPS)
    }

    /// Converts an activation to a number.
    pub fn value(&self, activation: i32) -> f64 {
        f64::from(activation) / f64::from(self.map.one())
    }
}
