//! A serial port.

use super::Port;
use crate::error::{Result, SourceError};
use serialport::SerialPort;
use std::io::{self, ErrorKind, Read, Write};
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);

/// Time for which a port has room: Linux keeps 4 KiB, and a board on USB sends some 200 KB a second.
const KEEPS: Duration = Duration::from_millis(10);

/// An open serial port.
pub struct Serial {
    port: Box<dyn SerialPort>,
    /// Bytes read while listening.
    heard: Vec<u8>,
}

impl Serial {
    /// Opens a port, 8N1.
    pub fn open(path: &str, baud: u32) -> Result<Serial> {
        // DTR: a board on USB sends only while the port is open, which it detects by this line.
        let port =
            serialport::new(path, baud).timeout(PATIENCE).dtr_on_open(true).open().map_err(|error| {
                let why = why(&error);
                SourceError::NoBoard(format!("serial port {path} at {baud} Bd cannot be opened: {why}"))
            })?;
        Ok(Serial { port, heard: Vec::new() })
    }

    /// Returns bytes, to be read again.
    pub fn unread(&mut self, bytes: Vec<u8>) {
        self.heard.splice(0..0, bytes);
    }
}

/// Why a port cannot be opened, in plain words.
fn why(error: &serialport::Error) -> String {
    match (error.kind(), error.description.as_str()) {
        (serialport::ErrorKind::NoDevice, _) => "another program has it open".into(),
        (serialport::ErrorKind::Io(ErrorKind::NotFound), _) => {
            "there is no such port; `taxel ports` lists the ports".into()
        }
        // The system's message about a file that is not a terminal.
        (_, "Not a typewriter" | "Inappropriate ioctl for device") => "it is not a serial port".into(),
        (_, told) => told.to_lowercase(),
    }
}

impl Port for Serial {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        if !self.heard.is_empty() {
            let count = self.heard.len().min(buffer.len());
            for (slot, byte) in buffer.iter_mut().zip(self.heard.drain(..count)) {
                *slot = byte;
            }
            return Ok(Some(count));
        }
        match self.port.read(buffer) {
            // End of file: the other end has hung up.
            Ok(0) => Ok(None),
            Ok(count) => Ok(Some(count)),
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(Some(0)),
            Err(error) => Err(error),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.port.write(bytes) {
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(0),
            written => written,
        }
    }

    fn keeps(&self) -> Duration {
        KEEPS
    }
}
