//! Labelled touches and their files.

use anyhow::Result;
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel::learn::fingerprint::Fingerprint;

/// A file of training data.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TouchesFile {
    /// Name without folders.
    pub file: String,
    /// Size.
    pub bytes: usize,
    /// FNV-1a of its bytes, 64 bits in hexadecimal.
    pub fnv1a: String,
}

impl TouchesFile {
    /// Reads a file and hashes it.
    pub fn of(path: &Path) -> Result<TouchesFile> {
        let Fingerprint { bytes, fnv1a } = Fingerprint::of(path)?;
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(TouchesFile { file, bytes, fnv1a })
    }
}

/// A touch from its first frame to its last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Touch {
    /// Frames, one after the other.
    pub values: Vec<u16>,
    /// Index of the class in [`Data::classes`].
    pub class: usize,
    /// Label in its recording.
    pub label: String,
    /// Group that is left out together in cross-validation: person, recording or day.
    pub group: String,
}

/// Touches on sheets of one size.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Data {
    /// Rows of a frame.
    pub rows: u16,
    /// Columns of a frame.
    pub columns: u16,
    /// Names of the classes.
    pub classes: Vec<String>,
    /// The touches.
    pub touches: Vec<Touch>,
    /// Periods without a touch; their class is unused.
    pub idle: Vec<Touch>,
    /// Warnings about the recordings.
    pub doubts: Vec<String>,
    /// The files.
    pub sources: Vec<TouchesFile>,
}

impl Data {
    /// Frames of a touch.
    pub fn frames<'a>(&self, touch: &'a Touch) -> std::slice::ChunksExact<'a, u16> {
        touch.values.chunks_exact(usize::from(self.rows) * usize::from(self.columns))
    }

    /// Groups, sorted.
    pub fn groups(&self) -> Vec<String> {
        let mut groups: Vec<String> = self.touches.iter().map(|touch| touch.group.clone()).collect();
        groups.sort();
        groups.dedup();
        groups
    }
}
