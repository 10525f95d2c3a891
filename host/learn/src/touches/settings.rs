//! Settings of a training.

use super::windows::Windows;
use serde::{Deserialize, Serialize};
use taxel_core::gesture::EXPERTS;

/// Most experts besides the one trained on whole touches.
pub const EARLY: usize = EXPERTS - 1;

/// Training settings, specific to a task and chosen by cross-validation.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrainSettings {
    /// Value above which a cell counts as touched.
    pub pressed: u16,
    /// True to train also on each half of a touch.
    pub halves: bool,
    /// Ridge penalty.
    pub penalty: f64,
    /// Balance: at 1 every class has the same weight, at 0 every example.
    pub balance: f64,
    /// True to train also on the mirror images of a touch.
    pub mirrored: bool,
    /// Training windows of the early experts, by age.
    #[serde(default)]
    pub early: [Option<Windows>; EARLY],
    /// True if the training touches are complete, so that the last expert decides at the end of a touch,
    /// however short. False if they are cut; then the expert of its age decides.
    #[serde(default)]
    pub concludes: bool,
}

/// Settings that differ from `one` in the values chosen by trial.
pub fn grid(one: TrainSettings, penalties: &[f64], balances: &[f64]) -> Vec<TrainSettings> {
    let mut all = Vec::new();
    for penalty in penalties {
        for balance in balances {
            all.push(TrainSettings { penalty: *penalty, balance: *balance, ..one });
        }
    }
    all
}
