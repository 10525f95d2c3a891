//! A temporary file beside an output: for what is too large to keep in memory until it is its turn.

use super::file::folder;
use super::part;
use anyhow::Result;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A temporary file, which is gone when this is dropped.
#[derive(Debug)]
pub struct Scratch {
    /// To be written and read.
    pub file: File,
    /// Where it is still listed in its folder.
    path: Option<PathBuf>,
}

impl Scratch {
    /// In the folder in which a file of that name is going to be: there is room for the one, and so for the
    /// other.
    pub fn beside(output: &Path) -> Result<Scratch> {
        let mut options = File::options();
        options.read(true).write(true).create_new(true);
        let (file, path) = part::make(folder(output), |path| options.open(path))?;
        // Where the system allows it, the name goes at once, so that not even a kill leaves anything behind.
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
