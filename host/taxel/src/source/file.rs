//! Bytes that were saved with `--save`.

use super::Port;
use anyhow::{Result, anyhow};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// An open file.
pub struct Saved(File);

impl Saved {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<Saved> {
        let wrong =
            |error: &dyn std::fmt::Display| anyhow!("file {} cannot be read: {error}", path.display());
        if path.is_dir() {
            return Err(wrong(&"it is a folder"));
        }
        File::open(path).map(Saved).map_err(|error| wrong(&error))
    }
}

impl Port for Saved {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let count = self.0.read(buffer)?;
        Ok((count > 0).then_some(count))
    }

    /// Discards the bytes: a file has no reader.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}
