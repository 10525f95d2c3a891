//! Settings of the stage.

use serde::{Deserialize, Serialize};

/// How shapes are recognised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ShapeConfig {
    /// Neighbours that vote: 1 to 9, and not more than the base has prototypes.
    pub k: u8,
    /// A contact farther than this from every prototype is unknown; in the units of [`super::Features`], at
    /// least 1.
    pub reject: u16,
}

impl Default for ShapeConfig {
    fn default() -> Self {
        ShapeConfig { k: 1, reject: 400 }
    }
}
