//! Settings of the recognition of touches, and the models that come with the program.

use super::certainty::Certainty;
use super::model::Model;
use super::model_error::ModelError;
use crate::format::Invalid;
use core::fmt;
use serde::{Deserialize, Serialize};

/// A model that comes with the program; `docs/evidence/models.md` has the model cards. Variants are only
/// appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShippedModel {
    /// Seven gestures: constant, notouch, pat, rub, scratch, stroke, tickle; 54 frames a second.
    #[default]
    Gestures,
    /// Kindness, threat, attack.
    Intent,
}

impl ShippedModel {
    /// Bytes of the model's file.
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            ShippedModel::Gestures => include_bytes!("../../models/gestures.model"),
            ShippedModel::Intent => include_bytes!("../../models/intent.model"),
        }
    }
}

/// Settings of the recognition of touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GestureConfig {
    /// The model.
    pub model: ShippedModel,
    /// Frames a second that the model gets, equal to the rate of its training; 1 ..= 200.
    pub rate_hz: u16,
    /// Counts of the model's sheet per count of the garment, Q8: 1 ..= 4096 (16.0). Needed because levels are
    /// features.
    pub gain: u16,
    /// Time without contact on the panel after which the touch has ended, ms.
    pub quiet_ms: u16,
    /// Time between two decisions, ms; at least 50.
    pub decide_ms: u16,
    /// Time that a class must lead before it is announced, ms.
    pub onset_ms: u16,
    /// Lead over the second class that another class needs to displace the announced one, in thousandths of a
    /// score. A model is fitted to score 1 for the class of a touch, and -1 for the others.
    pub lead: u16,
    /// Confidence that an announcement before the end of a touch needs, in thousandths, at most 999.
    pub certainty: u16,
}

impl Default for GestureConfig {
    fn default() -> Self {
        GestureConfig {
            model: ShippedModel::Gestures,
            rate_hz: 54,
            gain: 256,
            quiet_ms: 1000,
            decide_ms: 250,
            onset_ms: 250,
            lead: 200,
            certainty: 0,
        }
    }
}

/// Reason why settings are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GestureError {
    /// A parameter is out of its range.
    Invalid(Invalid),
    /// The model cannot be read.
    Model(ModelError),
}

impl fmt::Display for GestureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GestureError::Invalid(invalid) => invalid.fmt(f),
            GestureError::Model(model) => write!(f, "gestures.model: {model}"),
        }
    }
}

impl core::error::Error for GestureError {}

impl From<Invalid> for GestureError {
    fn from(invalid: Invalid) -> Self {
        GestureError::Invalid(invalid)
    }
}

impl From<ModelError> for GestureError {
    fn from(model: ModelError) -> Self {
        GestureError::Model(model)
    }
}

impl GestureConfig {
    /// The default settings for a model.
    pub fn of(model: ShippedModel) -> GestureConfig {
        GestureConfig { model, ..GestureConfig::default() }
    }

    /// Checks the settings and the model; returns the model.
    pub(super) fn check(&self) -> Result<Model<'static>, GestureError> {
        let refuse = |parameter, must| Err(Invalid { parameter, must }.into());
        if !(1..=200).contains(&self.rate_hz) {
            return refuse("gestures.rate_hz", "must be 1 to 200");
        }
        if !(1..=4096).contains(&self.gain) {
            return refuse("gestures.gain", "must be 1 to 4096 (16.0)");
        }
        if self.decide_ms < 50 {
            return refuse("gestures.decide_ms", "must be at least 50");
        }
        Certainty::of(self.certainty)?;
        Ok(Model::read(self.model.bytes())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_models_are_whole_and_bad_settings_are_named() {
        for model in [ShippedModel::Gestures, ShippedModel::Intent] {
            assert!(GestureConfig::of(model).check().is_ok());
        }
        let refused = |edit: fn(&mut GestureConfig)| {
            let mut config = GestureConfig::default();
            edit(&mut config);
            match config.check() {
                Err(GestureError::Invalid(invalid)) => invalid.parameter,
                _ => "",
            }
        };
        assert_eq!(refused(|c| c.rate_hz = 0), "gestures.rate_hz");
        assert_eq!(refused(|c| c.rate_hz = 201), "gestures.rate_hz");
        assert_eq!(refused(|c| c.gain = 0), "gestures.gain");
        assert_eq!(refused(|c| c.gain = 4097), "gestures.gain");
        assert_eq!(refused(|c| c.decide_ms = 49), "gestures.decide_ms");
        assert_eq!(refused(|c| c.certainty = 1000), "gestures.certainty");
    }
}
