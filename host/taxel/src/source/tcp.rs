//! A board behind TCP.

use super::Port;
use crate::error::{Result, SourceError};
use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

/// Longest wait of a read or write.
const PATIENCE: Duration = Duration::from_millis(10);
/// Time for which a connection has room: its buffers hold 64 KiB and more, and a board sends some 200 KB a second.
const KEEPS: Duration = Duration::from_millis(100);
/// Time limits for the first connection, and for a reconnection.
pub const CONNECT: Duration = Duration::from_secs(5);
pub(crate) const RETURN: Duration = Duration::from_secs(1);

/// An open connection.
pub struct Tcp(TcpStream);

impl Tcp {
    /// Connects to `HOST:PORT`, with this time limit for each of its addresses.
    pub fn open(address: &str, longest: Duration) -> Result<Tcp> {
        let wrong =
            |error: io::Error| SourceError::NoBoard(format!("tcp:{address} cannot be reached: {error}"));
        let mut last = io::Error::new(ErrorKind::NotFound, "the host has no address");
        let unknown =
            |_| SourceError::NoBoard(format!("tcp:{address} cannot be reached: its name has no address"));
        for target in address.to_socket_addrs().map_err(unknown)? {
            match TcpStream::connect_timeout(&target, longest) {
                Ok(stream) => return Ok(Tcp::of(stream).map_err(wrong)?),
                Err(error) => last = error,
            }
        }
        Err(wrong(last).into())
    }

    /// An open connection.
    pub fn of(stream: TcpStream) -> io::Result<Tcp> {
        stream.set_nonblocking(false)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        Ok(Tcp(stream))
    }
}

impl Port for Tcp {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        use ErrorKind::{ConnectionReset, Interrupted, TimedOut, WouldBlock};
        match self.0.read(buffer) {
            Ok(0) => Ok(None),
            Ok(count) => Ok(Some(count)),
            Err(error) if matches!(error.kind(), TimedOut | WouldBlock | Interrupted) => Ok(Some(0)),
            Err(error) if error.kind() == ConnectionReset => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        use ErrorKind::{Interrupted, TimedOut, WouldBlock};
        match self.0.write(bytes) {
            Err(error) if matches!(error.kind(), TimedOut | WouldBlock | Interrupted) => Ok(0),
            written => written,
        }
    }

    fn keeps(&self) -> Duration {
        KEEPS
    }
}
