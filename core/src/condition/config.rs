//! Settings of the stage.

use serde::{Deserialize, Serialize};

/// How codes become pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ConditionConfig {
    /// Calibrated values below this many counts are 0; at least 1.
    pub floor: u16,
    /// The 3x3 filter.
    pub filter: Filter,
    /// A tared baseline follows slow drift where nothing touches.
    pub track_baseline: bool,
}

/// A 3x3 filter over a panel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// None.
    Off,
    /// Clamps a taxel to the smallest and the largest of its eight neighbours. It removes impulses and
    /// bridges dropouts of a single taxel, and keeps fingers of two by two taxels, lines one taxel wide and
    /// the corners of every shape: a 3x3 median deletes all of those on a block of 4 x 16. It also removes
    /// what presses a single taxel for long.
    Conservative,
    /// The exact median of nine, the border replicated (as OpenCV and imageproc do).
    Median,
    /// Clamps a taxel to the greatest mean of the four squares of 2x2 taxels that it belongs to. It keeps
    /// fingers of two by two taxels, edges and right corners, halves lines one taxel wide and quarters
    /// impulses: for noise that is so strong that no taxel alone tells it from a touch
    /// (`Scene::against_noise`).
    Square,
    /// As [`Filter::Conservative`], but a taxel that exceeds its neighbours keeps what it had in the frame
    /// before, too: an impulse of one frame goes, and a point that presses a single taxel passes whole from
    /// its second frame on.
    #[default]
    Persistent,
}

impl Default for ConditionConfig {
    fn default() -> Self {
        ConditionConfig { floor: 24, filter: Filter::default(), track_baseline: true }
    }
}
