//! Settings of the stage.

use crate::filter::kinds::Filter;
use serde::{Deserialize, Serialize};

/// Settings of the conversion from codes to pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ConditionConfig {
    /// Calibrated values below this many counts are 0; at least 1.
    pub floor: u16,
    /// The 3x3 filter.
    pub filter: Filter,
    /// True if a tared baseline follows slow drift of untouched taxels.
    pub track_baseline: bool,
}

impl Default for ConditionConfig {
    fn default() -> Self {
        ConditionConfig { floor: 24, filter: Filter::default(), track_baseline: true }
    }
}
