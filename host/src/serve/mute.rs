//! Read-only stream; discards writes.

use std::io::{self, Read, Write};

/// A stream to which the reader of a WebSocket writes nothing: an answer of its own would fall into a message
/// of the writer's. Who closes or pings is not answered here.
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
