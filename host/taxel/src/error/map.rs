//! Errors of cognitive maps.

use taxel_core::intent::MapError;

/// Reason why a map, or what was asked of it, is invalid.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The file is of another version of the format.
    #[error("{text}")]
    Version {
        /// Version of the file.
        found: u32,
        /// Fault; with file and line if it was read from a file.
        text: String,
    },
    /// A value is invalid.
    #[error("{text}")]
    Value {
        /// Path of its key: `concept[1].name`.
        key: String,
        /// Fault; with file and line if it was read from a file.
        text: String,
    },
    /// A concept is named that the map does not have.
    #[error("map {map}: {user} names the unknown concept {concept}")]
    NoConcept {
        /// Name of the map.
        map: String,
        /// Part that names the concept: "an edge", "--of".
        user: String,
        /// The name.
        concept: String,
    },
    /// The map is incomplete, or its text is none of a map: not TOML or JSON, or with unknown keys.
    #[error("{0}")]
    Malformed(String),
    /// The core, which runs the map, refuses it.
    #[error(transparent)]
    Core(#[from] MapError),
    /// A number is out of its range, or has too many decimals.
    #[error("{0}")]
    Range(String),
    /// Map that is too large or too fine for the board's arithmetic.
    #[error("{0}")]
    TooLarge(String),
    /// A file of labelled touches does not fit the map.
    #[error("{0}")]
    Touches(String),
    /// Maps cannot be united, touches cannot be learned from, or a question has no answer.
    #[error("{0}")]
    Unanswerable(String),
}
