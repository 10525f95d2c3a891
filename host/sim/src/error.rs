//! Errors of scripts.

use std::fmt::Display;
use taxel_core::garment::GarmentError;

/// Reason why a script of touches is invalid, or does not fit a garment.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScriptError {
    /// The text is not a script: not TOML, or keys are missing or not known.
    #[error(transparent)]
    Malformed(#[from] toml::de::Error),
    /// A value is out of its range, or names what the garment does not have.
    #[error("{text}")]
    Value {
        /// The key.
        key: &'static str,
        /// Place, key, and what is wrong.
        text: String,
    },
    /// The garment itself is invalid.
    #[error("garment {garment}: {why}")]
    Garment {
        /// Name of the garment.
        garment: String,
        /// Error of the garment.
        why: GarmentError,
    },
    /// The garment cannot be scanned, or has more select lines than the emulator takes.
    #[error("{0}")]
    Unfit(String),
}

impl ScriptError {
    /// Error about the value of a key.
    pub(crate) fn value(key: &'static str, text: impl Into<String>) -> ScriptError {
        ScriptError::Value { key, text: text.into() }
    }

    /// Names the place of the value: "touch 1".
    #[must_use]
    pub fn inside(self, place: impl Display) -> ScriptError {
        match self {
            ScriptError::Value { key, text } => ScriptError::Value { key, text: format!("{place}: {text}") },
            other => other,
        }
    }

    /// The key whose value is wrong, if it is one.
    pub fn key(&self) -> Option<&'static str> {
        match self {
            ScriptError::Value { key, .. } => Some(key),
            _ => None,
        }
    }
}
