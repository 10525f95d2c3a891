//! Errors of settings.

use taxel_core::board::SetupError;
use taxel_core::garment::GarmentError;
use taxel_core::gesture::GestureError;
use taxel_core::pipeline::SceneError;
use taxel_sim::ScriptError;

/// Reason why a garment, a scene, a script, a calibration or a gesture's settings are invalid.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// A key of a file is invalid.
    #[error("{text}")]
    Key {
        /// Path of the key: `blocks[3].input`.
        key: String,
        /// File, line, key, and what is wrong.
        text: String,
    },
    /// A file is not TOML, or lacks a key, or has one that is not known.
    #[error("{0}")]
    Malformed(String),
    /// A garment is invalid.
    #[error(transparent)]
    Garment(#[from] GarmentError),
    /// A scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A garment and a scene do not go together.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A scene is too long for a request.
    #[error("{0}")]
    TooLong(String),
    /// A surface does not fit a board's table.
    #[error("{0}")]
    Surface(String),
    /// A table of folds does not fit the garment.
    #[error("{0}")]
    Folds(String),
    /// Panel whose fit cannot be found from its touches.
    #[error("{0}")]
    Placing(String),
    /// Settings of gestures are invalid.
    #[error(transparent)]
    Gestures(#[from] GestureError),
    /// A script of touches is invalid, or does not fit its garment.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A calibration is invalid, does not fit a garment, or cannot be computed from its readings.
    #[error("{0}")]
    Calibration(String),
}

impl SettingError {
    /// Path of the parameter that is invalid, if it is one: `contact.low`, `react[2].region`.
    pub fn parameter(&self) -> Option<String> {
        match self {
            SettingError::Key { key, .. } => Some(key.clone()),
            SettingError::Scene(error) | SettingError::Setup(SetupError::Scene(error)) => of_scene(error),
            SettingError::Gestures(error) => of_gestures(error),
            SettingError::Script(error) => error.key().map(String::from),
            _ => None,
        }
    }
}

fn of_scene(error: &SceneError) -> Option<String> {
    match error {
        SceneError::Invalid(invalid) => Some(invalid.parameter.into()),
        SceneError::Row(row) => {
            let dot = if row.invalid.parameter.is_empty() { "" } else { "." };
            Some(format!("{}[{}]{dot}{}", row.list, row.index, row.invalid.parameter))
        }
        SceneError::Map(_) => Some("intent.map".into()),
        SceneError::Gestures(error) => of_gestures(error),
    }
}

fn of_gestures(error: &GestureError) -> Option<String> {
    match error {
        GestureError::Invalid(invalid) => Some(invalid.parameter.into()),
        GestureError::Model(_) => Some("gestures.model".into()),
    }
}
