//! Intent: the meaning of a touch, by a fuzzy cognitive map over its measures.
//!
//! [`config`] is the configuration of a map, [`map`] the checked map, [`transfer`] the transfer functions,
//! [`infer`] the inference, [`input`] the encoding of a touch, [`felt`] sums over the whole garment,
//! [`evidence`] measures over the frames, `warmth` those of what is well meant, [`fed`] the host's values,
//! [`stage`] the decision with its debounce, [`why`] the explanation, [`mod@tactile`] the map that ships.

mod build;
pub mod config;
mod encode;
pub mod error;
pub mod evidence;
pub mod fed;
pub mod felt;
pub mod infer;
pub mod input;
pub mod leading;
pub mod map;
pub mod stage;
pub mod tactile;
pub mod transfer;
mod warmth;
pub mod why;

pub use config::{CONCEPTS, EDGES, Edge, IntentConfig, MapConfig, Rule, Threshold};
pub use error::MapError;
pub use evidence::Evidence;
pub use fed::{Fed, Feed, SLOTS};
pub use felt::Felt;
pub use infer::{Inference, Outcome};
pub use input::{MapInput, Source, Touch};
pub use leading::Leading;
pub use map::Map;
pub use stage::{Intent, IntentState, Meaning};
pub use tactile::{PRESS_PER_NEWTON, tactile};
pub use transfer::Transfer;
pub use why::{Contribution, Why};

#[cfg(test)]
mod tests;
