//! Kinds of errors.

use super::{
    ArrayError, FileError, LearnError, MapFileError, RecordingError, RobotError, SettingError, SourceError,
    UsageError,
};
use std::io;

/// Kind of an error, by concern.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// An array of frames cannot be used.
    #[error(transparent)]
    Array(#[from] ArrayError),
    /// A recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A setting is invalid.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A robot's description is invalid, or does not fit what is asked of it.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A cognitive map is invalid.
    #[error(transparent)]
    Map(#[from] MapFileError),
    /// A source cannot be opened, or is lost.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// Nothing can be trained, or something trained cannot be used.
    #[error(transparent)]
    Learn(#[from] LearnError),
    /// An argument is wrong.
    #[error(transparent)]
    Usage(#[from] UsageError),
    /// An error of another library, or of the caller's own callbacks.
    #[error(transparent)]
    Other(Box<dyn std::error::Error + Send + Sync>),
}

impl ErrorKind {
    /// The system's error, if it is the reason.
    pub fn io(&self) -> Option<&io::Error> {
        match self {
            ErrorKind::File(error) => error.io(),
            _ => None,
        }
    }

    /// Path of the parameter that is invalid, if it is one: `contact.low`, `concept[1].name`.
    pub fn parameter(&self) -> Option<String> {
        match self {
            ErrorKind::Setting(error) | ErrorKind::Usage(UsageError::Setting(error)) => error.parameter(),
            ErrorKind::Map(MapFileError::Value { key, .. }) => Some(key.clone()),
            _ => None,
        }
    }
}

impl From<io::Error> for ErrorKind {
    fn from(error: io::Error) -> ErrorKind {
        FileError::Io(error).into()
    }
}

/// Errors with a kind of their own.
macro_rules! of_kind {
    ($($error:ty => $kind:ident),* $(,)?) => {
        $(impl From<$error> for ErrorKind {
            fn from(error: $error) -> ErrorKind {
                $kind::from(error).into()
            }
        })*
    };
}

of_kind! {
    taxel_core::board::SetupError => SettingError,
    taxel_core::garment::GarmentError => SettingError,
    taxel_core::gesture::GestureError => SettingError,
    taxel_core::pipeline::SceneError => SettingError,
    taxel_sim::ScriptError => SettingError,
    taxel_core::intent::MapError => MapFileError,
    taxel_core::gesture::ModelError => LearnError,
    taxel_core::wire::WireError => SourceError,
}

/// Errors of other libraries.
macro_rules! others {
    ($($error:ty),* $(,)?) => {
        $(impl From<$error> for ErrorKind {
            fn from(error: $error) -> ErrorKind {
                ErrorKind::Other(error.into())
            }
        })*
    };
}

others! {
    binrw::Error,
    mcap::McapError,
    postcard::Error,
    serde_json::Error,
    std::num::TryFromIntError,
    toml::ser::Error,
    toml::de::Error,
}
