//! Intent: what a touch means, by a fuzzy cognitive map over what was measured of it.
//!
//! [`config`] is what the author of a map writes, [`map`] the map with its checks, [`transfer`] the transfer
//! functions, [`infer`] the inference, [`input`] the encoding of a touch, [`felt`] what lies on the whole
//! garment, [`evidence`] what is remembered of it, [`fed`] what the host feeds, [`stage`] the decision with
//! its debounce, [`why`] the reason for it, [`mod@tactile`] the map that ships.

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
pub mod why;

pub use config::{CONCEPTS, EDGES, Edge, IntentConfig, MapConfig, Rule, Threshold};
pub use error::MapError;
pub use evidence::Evidence;
pub use fed::{Fed, Feed, SLOTS};
pub use felt::Felt;
pub use infer::{Inference, Outcome};
pub use input::{Input, Source, Touch};
pub use leading::Leading;
pub use map::Map;
pub use stage::{Intent, IntentState, Meaning};
pub use tactile::{PRESS_PER_NEWTON, tactile};
pub use transfer::Transfer;
pub use why::{Part, Why};

#[cfg(test)]
mod tests;
