//! Errors of arrays.

/// Why the frames or the list of a file are not there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArrayError {
    /// The file is none of arrays, or has none of frames.
    #[error("{0}")]
    NotAnArray(String),
    /// It is cut off, or its bytes contradict each other.
    #[error("{0}")]
    Damaged(String),
    /// Its type, its shape or a value is not that of frames.
    #[error("{0}")]
    Unfit(String),
    /// It takes more memory than such a file may.
    #[error("{0}")]
    TooLarge(String),
}
