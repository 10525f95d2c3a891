//! Errors of recordings.

use std::path::PathBuf;

/// Reason why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file is not a recording.
    #[error("{} is not an MCAP file", path.display())]
    NotMcap {
        /// The file.
        path: PathBuf,
    },
    /// Recording of another program.
    #[error("{} has no topic {topic}: it is not a recording of taxel", path.display())]
    NotTaxel {
        /// The file.
        path: PathBuf,
        /// The topic that it lacks.
        topic: &'static str,
    },
    /// A part that is asked for is damaged. Readers that go from beginning to end skip such parts, and count
    /// them. The [cause](super::Error::cause) says what is wrong.
    #[error("{} is damaged", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// A record contradicts itself.
    #[error("{0}")]
    Record(String),
    /// Valid recording, written in a way that this library does not read.
    #[error("{0}")]
    Unsupported(String),
}
