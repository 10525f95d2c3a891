//! A file or the standard input, read by a thread of its own, because they block.

use super::super::Port;
use std::io::{self, Read};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);
/// Bytes of a piece, and pieces that wait.
const PIECE: usize = 4096;
const PIECES: usize = 16;

/// Bytes of a reader.
pub struct Piped {
    pieces: Receiver<io::Result<Vec<u8>>>,
    piece: Vec<u8>,
}

impl Piped {
    /// Begins to read.
    pub fn new(mut reader: impl Read + Send + 'static) -> io::Result<Piped> {
        let (sender, pieces) = sync_channel(PIECES);
        let read = move || {
            let mut buffer = vec![0; PIECE];
            loop {
                let piece = match reader.read(&mut buffer) {
                    Ok(0) => return,
                    Ok(count) => Ok(buffer[..count].to_vec()),
                    Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                    Err(error) => Err(error),
                };
                if sender.send(piece).is_err() {
                    return;
                }
            }
        };
        thread::Builder::new().name("input".into()).spawn(read)?;
        Ok(Piped { pieces, piece: Vec::new() })
    }
}

impl Port for Piped {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        if self.piece.is_empty() {
            match self.pieces.recv_timeout(PATIENCE) {
                Ok(piece) => self.piece = piece?,
                Err(RecvTimeoutError::Timeout) => return Ok(Some(0)),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
            }
        }
        let count = self.piece.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.piece[..count]);
        self.piece.drain(..count);
        Ok(Some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}
