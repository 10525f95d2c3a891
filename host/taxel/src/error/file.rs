//! Errors of files.

use std::io;
use std::path::{Path, PathBuf};

/// Reason why a file cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// There is no such file.
    #[error("{why}")]
    Missing {
        /// The file.
        path: PathBuf,
        /// The system's words.
        why: io::Error,
    },
    /// The file exists, and cannot be read.
    #[error("{why}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's words.
        why: io::Error,
    },
    /// Something that is no file.
    #[error("it is {what}")]
    NoFile {
        /// Path of it.
        path: PathBuf,
        /// Kind of it: a folder, a device, a FIFO, a socket.
        what: &'static str,
    },
    /// The output exists already, and may not be replaced.
    #[error("{} already exists: give another name, or --force to replace it", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// An output cannot be here: the name is that of a folder, a link, a device, a read-only file.
    #[error("{0}")]
    Output(String),
    /// The system fails on the way: the disk is full, a device is gone.
    #[error(transparent)]
    Io(io::Error),
}

impl FileError {
    /// Error of a file that was to be read.
    pub fn read(path: &Path, why: io::Error) -> FileError {
        let path = path.into();
        match why.kind() {
            io::ErrorKind::NotFound => FileError::Missing { path, why },
            _ => FileError::Unreadable { path, why },
        }
    }

    /// The system's error.
    pub fn io(&self) -> Option<&io::Error> {
        match self {
            FileError::Missing { why, .. } | FileError::Unreadable { why, .. } | FileError::Io(why) => {
                Some(why)
            }
            FileError::NoFile { .. } | FileError::Exists { .. } | FileError::Output(_) => None,
        }
    }
}
