//! Settings of the stage.

use serde::{Deserialize, Serialize};

/// Settings of shape recognition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ShapeConfig {
    /// Number of neighbours that vote: 1 to 9, and at most the number of prototypes.
    pub k: u8,
    /// Greatest distance from the nearest prototype at which a contact is recognised, at least 1; in the
    /// units of [`super::ShapeFeatures`].
    pub reject: u16,
}

impl Default for ShapeConfig {
    fn default() -> Self {
        ShapeConfig { k: 1, reject: 400 }
    }
}
