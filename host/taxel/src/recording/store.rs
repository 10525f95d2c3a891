//! Destination of a recording.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// Bytes that are appended, and truncated after a partial write.
pub trait Store: Write {
    /// Returns once the written bytes are on the disk.
    fn keep(&mut self) -> io::Result<()>;

    /// Truncates to `length` bytes; writing continues there.
    fn cut(&mut self, length: u64) -> io::Result<()>;

    /// Reads written bytes from `offset` on, and returns their number. Writing still continues at the end.
    /// Error if they cannot be read back, as from a pipe or a socket.
    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize>;
}

impl<S: Store + ?Sized> Store for &mut S {
    fn keep(&mut self) -> io::Result<()> {
        (**self).keep()
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        (**self).cut(length)
    }

    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize> {
        (**self).look(offset, bytes)
    }
}

/// A recording in memory.
impl Store for Vec<u8> {
    fn keep(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.truncate(usize::try_from(length).unwrap_or(usize::MAX));
        Ok(())
    }

    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize> {
        let from = usize::try_from(offset).unwrap_or(usize::MAX);
        let mut written = self.get(from..).unwrap_or(&[]);
        written.read(bytes)
    }
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
