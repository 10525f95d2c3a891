//! Files of recorded touches.

use anyhow::{Result, ensure};
use clap::Args;
use std::path::{Path, PathBuf};

/// Recorded touches.
#[derive(Debug, Clone, Args)]
pub struct Files {
    /// Frames of all recordings, one after the other
    #[arg(long, value_name = "F.npz")]
    pub frames: PathBuf,
    /// A line for each recording (columns gesture and participant) or for each frame (columns recording and
    /// label)
    #[arg(long, value_name = "L.csv")]
    pub labels: Option<PathBuf>,
}

/// Path of the labels of recorded touches; error if it is missing.
pub fn labels(files: &Files) -> Result<&Path> {
    let frames = files.frames.display();
    ensure!(
        files.labels.is_some(),
        "{frames}: frames of touches hold no labels of their own, name their file with --labels"
    );
    Ok(files.labels.as_deref().unwrap_or(&files.frames))
}
