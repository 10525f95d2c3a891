//! The meaning of the touch as JSON.

use serde::Serialize;
use serde_json::{Map, Value};
use taxel_core::format::{Name, Q15};
use taxel_core::intent::Leading;

/// The leading intention and the state of the map.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeaningOfTouch {
    /// The announced intention: `none`, `kindness`, `threat` or `attack`.
    pub leading: &'static str,
    /// Activation of each concept of the map, -1 to 1.
    #[cfg_attr(feature = "schema", schemars(with = "std::collections::BTreeMap<String, f64>"))]
    pub concepts: Map<String, Value>,
}

impl MeaningOfTouch {
    /// The meaning by these activations of the named concepts.
    pub fn of(leading: Leading, names: &[Name], concepts: &[Q15]) -> MeaningOfTouch {
        let each = names.iter().zip(concepts).map(|(name, value)| (name.to_string(), value.to_f64().into()));
        MeaningOfTouch { leading: leading.as_str(), concepts: each.collect() }
    }
}
