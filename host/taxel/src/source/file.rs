//! Bytes that were saved with `--save`.

use super::Port;
use crate::error::{Context, Result};
use crate::files::input;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// An open file.
pub struct Saved(File);

impl Saved {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<Saved> {
        input::open(path).map(Saved).with_context(|| format!("file {} cannot be read", path.display()))
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
