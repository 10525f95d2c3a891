//! Errors of the caller.

use super::setting::SettingError;

/// Reason why an argument cannot be what is meant.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UsageError {
    /// A name of something that does not exist: a source, a garment, a script, a map, a base, an array.
    #[error("{0}")]
    Unknown(String),
    /// An argument is out of its range, or contradicts another one.
    #[error("{0}")]
    Argument(String),
    /// A setting is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}
