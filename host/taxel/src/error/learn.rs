//! Errors of training.

use taxel_core::gesture::ModelError;

/// Reason why nothing can be trained, or something trained cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LearnError {
    /// Images, touches and labels do not fit each other, or are too few.
    #[error("{0}")]
    Data(String),
    /// The file is not a base of shapes, or not a valid one.
    #[error("{0}")]
    Base(String),
    /// A base of shapes of another version.
    #[error("{0}")]
    Version(String),
    /// A base or a model exceeds what a board holds.
    #[error("{0}")]
    TooLarge(String),
    /// The file is not a model of touches, or not a valid one.
    #[error(transparent)]
    Model(#[from] ModelError),
}
