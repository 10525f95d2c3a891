//! Errors of a scene.

use crate::format::{Invalid, InvalidRow};
use crate::gesture::GestureError;
use crate::intent::MapError;
use core::fmt;

/// Error of a scene for a garment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SceneError {
    /// A parameter is out of its range.
    Invalid(Invalid),
    /// A row of a list has a parameter that is out of its range.
    Row(InvalidRow),
    /// The map is invalid.
    Map(MapError),
    /// The recognition of gestures is invalid.
    Gestures(GestureError),
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SceneError::Invalid(invalid) => invalid.fmt(f),
            SceneError::Row(row) => row.fmt(f),
            SceneError::Map(map) => write!(f, "intent.map: {map}"),
            SceneError::Gestures(gestures) => gestures.fmt(f),
        }
    }
}

impl core::error::Error for SceneError {}

impl From<Invalid> for SceneError {
    fn from(invalid: Invalid) -> Self {
        SceneError::Invalid(invalid)
    }
}

impl From<InvalidRow> for SceneError {
    fn from(row: InvalidRow) -> Self {
        SceneError::Row(row)
    }
}

impl From<MapError> for SceneError {
    fn from(map: MapError) -> Self {
        SceneError::Map(map)
    }
}

impl From<GestureError> for SceneError {
    fn from(gestures: GestureError) -> Self {
        SceneError::Gestures(gestures)
    }
}
