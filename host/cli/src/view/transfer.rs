//! A recording that is sent while it is written, in HTTP's chunked coding, so that a browser can detect a
//! truncated one.

use std::io::{self, Write};
use taxel::recording::Store;

/// Writes the body in chunks.
pub struct Transfer<W: Write>(pub W);

impl<W: Write> Transfer<W> {
    /// Ends the body.
    pub fn end(&mut self) -> io::Result<()> {
        self.0.write_all(b"0\r\n\r\n")?;
        self.0.flush()
    }
}

impl<W: Write> Write for Transfer<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if !bytes.is_empty() {
            // An empty chunk would end the body.
            write!(self.0, "{:x}\r\n", bytes.len())?;
            self.0.write_all(bytes)?;
            self.0.write_all(b"\r\n")?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Write> Store for Transfer<W> {
    fn keep(&mut self) -> io::Result<()> {
        self.0.flush()
    }

    /// Sent bytes cannot be taken back. It is called after a failed write: the reader is gone, which is the
    /// error.
    fn cut(&mut self, _: u64) -> io::Result<()> {
        Err(io::ErrorKind::BrokenPipe.into())
    }

    fn look(&mut self, _: u64, _: &mut [u8]) -> io::Result<usize> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_bear_their_length_and_the_last_is_empty() {
        let mut sent = Vec::new();
        let mut transfer = Transfer(&mut sent);
        transfer.write_all(b"sixteen bytes ..").unwrap();
        transfer.write_all(b"").unwrap();
        transfer.end().unwrap();
        assert_eq!(sent, b"10\r\nsixteen bytes ..\r\n0\r\n\r\n");
    }
}
