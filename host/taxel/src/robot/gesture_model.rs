//! The gesture models of the board's firmware, by name.

use serde::Deserialize;
use taxel_core::gesture::ShippedModel;

/// A model of gestures in the board's firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum GestureModel {
    /// constant, notouch, pat, rub, scratch, stroke, tickle
    Gestures,
    /// kindness, threat, attack
    Intent,
}

impl From<GestureModel> for ShippedModel {
    fn from(model: GestureModel) -> ShippedModel {
        match model {
            GestureModel::Gestures => ShippedModel::Gestures,
            GestureModel::Intent => ShippedModel::Intent,
        }
    }
}
