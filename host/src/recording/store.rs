//! What a recording is written to.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// Bytes that are appended, and cut back where they could not be written whole.
pub trait Store: Write {
    /// What was written is on the disk when this returns.
    fn keep(&mut self) -> io::Result<()>;

    /// Forgets what lies behind the first `length` bytes; the next ones follow there.
    fn cut(&mut self, length: u64) -> io::Result<()>;

    /// Reads what was written, from `offset` on: how many bytes there were. What is written next follows what
    /// was written last, as before. An error: it cannot be read, as what goes through a pipe or a socket
    /// cannot.
    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize>;
}

impl Store for File {
    fn keep(&mut self) -> io::Result<()> {
        self.sync_data()
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.set_len(length)?;
        self.seek(SeekFrom::Start(length)).map(|_| ())
    }

    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize> {
        if !self.metadata()?.is_file() {
            return Err(io::ErrorKind::Unsupported.into());
        }
        let place = self.stream_position()?;
        self.seek(SeekFrom::Start(offset))?;
        let mut count = 0;
        while count < bytes.len() {
            match self.read(&mut bytes[count..])? {
                0 => break,
                read => count += read,
            }
        }
        self.seek(SeekFrom::Start(place)).map(|_| count)
    }
}
