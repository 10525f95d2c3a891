//! Settings of the stage.

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

/// A 3x3 filter over a panel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// No filter.
    Off,
    /// Clamps a taxel to the smallest and the largest of its eight neighbours. It removes impulses and
    /// bridges dropouts of a single taxel, and keeps fingers of 2x2 taxels, lines one taxel wide and the
    /// corners of every shape: a 3x3 median deletes all of those on a block of 4 x 16. It also removes
    /// lasting pressure on a single taxel.
    Conservative,
    /// The exact median of nine, the border replicated (as OpenCV and imageproc do).
    Median,
    /// Clamps a taxel to the greatest mean of the four 2x2 squares that it belongs to. It keeps fingers of
    /// 2x2 taxels, edges and right corners, halves lines one taxel wide and quarters impulses. For noise so
    /// strong that no taxel alone tells it from a touch (`Scene::against_noise`).
    Square,
    /// Clamps like [`Filter::Conservative`], but a taxel that exceeds its neighbours keeps the value it also
    /// had in the previous frame: an impulse of one frame is removed, and a point on a single taxel passes
    /// whole from its second frame on.
    #[default]
    Persistent,
}

impl Default for ConditionConfig {
    fn default() -> Self {
        ConditionConfig { floor: 24, filter: Filter::default(), track_baseline: true }
    }
}
