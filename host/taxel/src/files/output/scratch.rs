//! A temporary file beside an output, for data too large for memory.

use super::named::folder;
use super::part;
use crate::error::Result;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A temporary file, deleted when dropped.
#[derive(Debug)]
pub struct Scratch {
    /// The file, for writing and reading.
    pub file: File,
    /// Path, if it still has a name in its folder.
    path: Option<PathBuf>,
}

impl Scratch {
    /// Creates it in the folder of a future output, where there must be room anyway.
    pub fn beside(output: &Path) -> Result<Scratch> {
        let mut options = File::options();
        options.read(true).write(true).create_new(true);
        let (file, path) = part::make(folder(output), |path| options.open(path))?;
        // If the system allows it, the name is removed at once, so that even a kill leaves nothing behind.
        let path = fs::remove_file(&path).is_err().then_some(path);
        Ok(Scratch { file, path })
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            _ = fs::remove_file(path);
        }
    }
}
