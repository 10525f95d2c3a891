//! Labelled touches and where they come from.

use crate::learn::fingerprint::Fingerprint;
use anyhow::Result;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A file that was learnt from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// Its name without folders.
    pub file: String,
    /// Its length.
    pub bytes: usize,
    /// FNV-1a of its bytes, 64 bits in hexadecimal.
    pub fnv1a: String,
}

impl Source {
    /// Reads a file for its hash.
    pub fn of(path: &Path) -> Result<Source> {
        let Fingerprint { bytes, fnv1a } = Fingerprint::of(path)?;
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Source { file, bytes, fnv1a })
    }
}

/// A touch from its first frame to its last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Touch {
    /// Frames after frames.
    pub values: Vec<u16>,
    /// Its class, of [`Data::classes`].
    pub class: usize,
    /// What it is called in its recording.
    pub label: String,
    /// Whose it is, or of which recording or day: what is kept apart in cross-validation.
    pub group: String,
}

/// Touches of one kind of sheet.
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
    /// Stretches in which nobody touches; their class means nothing.
    pub idle: Vec<Touch>,
    /// What speaks against the recordings, in sentences.
    pub doubts: Vec<String>,
    /// The files.
    pub sources: Vec<Source>,
}

impl Data {
    /// The frames of a touch.
    pub fn frames<'a>(&self, touch: &'a Touch) -> std::slice::ChunksExact<'a, u16> {
        touch.values.chunks_exact(usize::from(self.rows) * usize::from(self.columns))
    }

    /// What is kept apart, in order.
    pub fn groups(&self) -> Vec<String> {
        let mut groups: Vec<String> = self.touches.iter().map(|touch| touch.group.clone()).collect();
        groups.sort();
        groups.dedup();
        groups
    }
}
