//! Which model recognises the touches of a garment, and how its decisions are announced.

use super::model::{Model, ModelError};
use crate::format::Invalid;
use core::fmt;
use serde::{Deserialize, Serialize};

/// A model that comes with the program; `docs/models.md` holds their cards. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shipped {
    /// Seven gestures: constant, notouch, pat, rub, scratch, stroke, tickle; 54 frames a second.
    #[default]
    Gestures,
    /// Kindness, threat, attack.
    Intent,
}

impl Shipped {
    /// The bytes of the model's file.
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            Shipped::Gestures => include_bytes!("../../models/gestures.model"),
            Shipped::Intent => include_bytes!("../../models/intent.model"),
        }
    }
}

/// How touches are recognised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GestureConfig {
    /// The model.
    pub model: Shipped,
    /// Frames a second that the model is shown, as many as it was trained with, 1 ..= 200.
    pub rate_hz: u16,
    /// Counts of the model's sheet per count of the garment, Q8: 1 ..= 4096 (16.0). Levels are features.
    pub gain: u16,
    /// A panel that nothing touches for so long, in ms, has been let go.
    pub quiet_ms: u16,
    /// Time between two decisions, ms, at least 50.
    pub decide_ms: u16,
    /// Time that a class must lead before it is announced, ms.
    pub onset_ms: u16,
    /// Lead over the second that another class needs to take the place of the announced one, in thousandths of
    /// a score: a model is fitted to score 1 for what a touch is, and -1 for the others.
    pub lead: u16,
}

impl Default for GestureConfig {
    fn default() -> Self {
        GestureConfig {
            model: Shipped::Gestures,
            rate_hz: 54,
            gain: 256,
            quiet_ms: 1000,
            decide_ms: 250,
            onset_ms: 250,
            lead: 200,
        }
    }
}

/// Why touches cannot be recognised like that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GestureError {
    /// A parameter is out of its range.
    Invalid(Invalid),
    /// The model is wrong.
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
    /// The usual settings for a model.
    pub fn of(model: Shipped) -> GestureConfig {
        GestureConfig { model, ..GestureConfig::default() }
    }

    /// Checks the settings, and the model, which it gives.
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
        Ok(Model::read(self.model.bytes())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_models_are_whole_and_bad_settings_are_named() {
        for model in [Shipped::Gestures, Shipped::Intent] {
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
    }
}
