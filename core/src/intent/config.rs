//! What the author of a map writes, in decimal steps: the form that travels in a scene.

use super::input::Input;
use super::transfer::Transfer;
use crate::format::Name;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Concepts of a map on the board, unless a type says otherwise.
pub const CONCEPTS: usize = 64;
/// Edges of a map on the board, unless a type says otherwise.
pub const EDGES: usize = 256;
/// The finest decimal step is 10^-4: products of weight and state then fit 32 bits.
pub const DECIMALS: u8 = 4;

/// What is summed for a concept. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rule {
    /// Its causes only: z_j = sum W\[i\]\[j\] x_i.
    #[default]
    Kosko,
    /// Its causes and itself: z_j = sum W\[i\]\[j\] x_i + x_j.
    #[serde(alias = "mKosko")]
    Mkosko,
    /// As mkosko with 2 x - 1 in the place of every x, so that an activation of 1/2 means "not known".
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

/// A threshold that one concept has for itself.
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
    /// What the map is called.
    pub name: Name,
    /// Names of the concepts, all different; their order is the order of every state.
    pub concepts: Vec<Name, N>,
    /// The decimal step is 10^-decimals, 0 ..= 4.
    pub decimals: u8,
    /// Causal edges, each pair once.
    pub edges: Vec<Edge, E>,
    /// What is summed.
    pub rule: Rule,
    /// What the sum becomes.
    pub transfer: Transfer,
    /// Steepness of the smooth transfer functions in 1/1000, not 0; without effect on the others.
    pub lambda: u16,
    /// T of every concept, in steps, -1 ..= 1.
    pub threshold: i16,
    /// T of single concepts, in the place of `threshold`.
    pub thresholds: Vec<Threshold, N>,
    /// Whether concepts without an incoming edge keep their value (usual) or follow the rule like the others.
    pub held: bool,
    /// Which concepts are fed from the touch or the host, and how.
    pub inputs: Vec<Input, N>,
}

/// What the stage is to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntentConfig<const N: usize = CONCEPTS, const E: usize = EDGES> {
    /// The map.
    pub map: MapConfig<N, E>,
    /// Time that an intention must lead before it is announced, in ms.
    pub onset_ms: u16,
    /// Activation from which an intention may lead, in thousandths.
    pub level: u16,
    /// Lead over the other two that it needs, in thousandths.
    pub margin: u16,
    /// Time after the release for which the touch still counts, in ms.
    pub hold_ms: u16,
    /// Shortest time between two inferences of one touch, in ms; its beginning and its end are never waited
    /// for.
    pub period_ms: u16,
    /// Largest number of steps of an inference.
    pub steps: u16,
}

impl<const N: usize, const E: usize> IntentConfig<N, E> {
    /// The usual settings with a map: 30 ms onset, level 0.5, margin 0.1, 600 ms hold, 20 ms period, 16 steps.
    pub fn new(map: MapConfig<N, E>) -> Self {
        IntentConfig { map, onset_ms: 30, level: 500, margin: 100, hold_ms: 600, period_ms: 20, steps: 16 }
    }
}
