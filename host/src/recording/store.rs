//! What a recording is written to.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};

/// Bytes that are appended, and cut back where they could not be written whole.
pub trait Store: Write {
    /// What was written is on the disk when this returns.
    fn keep(&mut self) -> io::Result<()>;

    /// Forgets what lies behind the first `length` bytes; the next ones follow there.
    fn cut(&mut self, length: u64) -> io::Result<()>;
}

impl Store for File {
    fn keep(&mut self) -> io::Result<()> {
        self.sync_data()
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.set_len(length)?;
        self.seek(SeekFrom::Start(length)).map(|_| ())
    }
}
