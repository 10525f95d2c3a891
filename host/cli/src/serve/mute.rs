//! Read-only stream; discards writes.

use std::io::{self, Read, Write};

/// The stream given to the reader of a WebSocket, whose writes are discarded: its own replies could fall into
/// a message of the writer. Closes and pings are not answered.
pub struct Mute<R>(pub R);

impl<R: Read> Read for Mute<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl<R> Write for Mute<R> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
