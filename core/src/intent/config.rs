//! Configuration of a map as its author writes it, in decimal steps. A scene contains this form.

use super::input::MapInput;
use super::transfer::Transfer;
use crate::format::Name;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Default capacity for the concepts of a map; none without the feature `intent`.
pub const CONCEPTS: usize = if cfg!(feature = "intent") { 64 } else { 0 };
/// Default capacity for the edges of a map; none without the feature `intent`.
pub const EDGES: usize = if cfg!(feature = "intent") { 256 } else { 0 };
/// Greatest number of decimals: with steps of 10^-4, products of weight and state fit in 32 bits.
pub const DECIMALS: u8 = 4;

/// The sum from which a concept's activation follows. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rule {
    /// Sum over its causes: z_j = sum W\[i\]\[j\] x_i.
    #[default]
    Kosko,
    /// Sum over its causes and itself: z_j = sum W\[i\]\[j\] x_i + x_j.
    #[serde(alias = "mKosko")]
    Mkosko,
    /// Like mkosko with 2 x - 1 instead of every x, so that an activation of 1/2 means "not known".
    Rescaled,
}

/// One causal edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edge {
    /// Index of the cause.
    pub from: u8,
    /// Index of the effect.
    pub to: u8,
    /// Causality value in decimal steps, -1 ..= 1.
    pub weight: i16,
}

/// Threshold of a single concept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Threshold {
    /// Index of the concept.
    pub concept: u8,
    /// T in decimal steps, -1 ..= 1.
    pub value: i16,
}

/// A map as written by its author. A "step" is 10^-`decimals`.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapConfig<const N: usize = CONCEPTS, const E: usize = EDGES> {
    /// Name of the map.
    pub name: Name,
    /// Names of the concepts, all different; every state has their order.
    pub concepts: Vec<Name, N>,
    /// The decimal step is 10^-decimals, 0 ..= 4.
    pub decimals: u8,
    /// Causal edges, each pair once.
    pub edges: Vec<Edge, E>,
    /// Rule of the sum.
    pub rule: Rule,
    /// Function of the sum that gives the activation.
    pub transfer: Transfer,
    /// Steepness of the smooth transfer functions in 1/1000, not 0; no effect on the others.
    pub lambda: u16,
    /// T of every concept, in steps, -1 ..= 1.
    pub threshold: i16,
    /// T of single concepts; overrides `threshold`.
    pub thresholds: Vec<Threshold, N>,
    /// True if concepts without an incoming edge keep their value (usual); false if they follow the rule like
    /// all others.
    pub held: bool,
    /// Inputs: the concepts that the touch or the host sets, with their ramps.
    pub inputs: Vec<MapInput, N>,
}

/// Configuration of the stage.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntentConfig<const N: usize = CONCEPTS, const E: usize = EDGES> {
    /// The map.
    pub map: MapConfig<N, E>,
    /// Time that an intention must lead before it is announced, ms.
    pub onset_ms: u16,
    /// Activation from which an intention may lead, in thousandths.
    pub level: u16,
    /// Lead over the other two that it needs, in thousandths.
    pub margin: u16,
    /// Time after the release for which the touch still counts, ms.
    pub hold_ms: u16,
    /// Shortest time between two inferences of one touch, ms. The beginning and the end of a touch do not
    /// wait for it.
    pub period_ms: u16,
    /// Greatest number of steps of an inference.
    pub steps: u16,
}

impl<const N: usize, const E: usize> IntentConfig<N, E> {
    /// Default settings with a map: 30 ms onset, level 0.5, margin 0.1, 600 ms hold, 20 ms period, 16 steps.
    pub fn new(map: MapConfig<N, E>) -> Self {
        IntentConfig { map, onset_ms: 30, level: 500, margin: 100, hold_ms: 600, period_ms: 20, steps: 16 }
    }
}
