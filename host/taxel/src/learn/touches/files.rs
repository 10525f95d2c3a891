//! Files of recorded touches.

use crate::error::{Result, UsageError};
use std::path::{Path, PathBuf};

/// Recorded touches.
#[derive(Debug, Clone)]
pub struct Files {
    /// Frames of all recordings, one after the other.
    pub frames: PathBuf,
    /// A line for each recording (columns gesture and participant) or for each frame (columns recording and
    /// label).
    pub labels: Option<PathBuf>,
}

/// Path of the labels of recorded touches; error if it is missing.
pub fn labels(files: &Files) -> Result<&Path> {
    let frames = files.frames.display();
    require!(
        files.labels.is_some(),
        UsageError::Argument,
        "{frames}: frames of touches hold no labels of their own, name their file with --labels"
    );
    Ok(files.labels.as_deref().unwrap_or(&files.frames))
}
