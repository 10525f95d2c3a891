//! Errors of arrays.

/// Reason why the frames or the list of a file are not there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArrayError {
    /// The file is none of arrays, or has none of frames.
    #[error("{0}")]
    NotAnArray(String),
    /// File that is cut off, or whose bytes contradict each other.
    #[error("{0}")]
    Damaged(String),
    /// Array whose type, shape or a value is not that of frames.
    #[error("{0}")]
    Unfit(String),
    /// File that takes more memory than such a file may.
    #[error("{0}")]
    TooLarge(String),
}
