//! Datagrams that a device sends to a port of this machine.

use super::super::Port;
use crate::error::{Result, SourceError};
use std::io::{self, ErrorKind};
use std::net::{Ipv4Addr, UdpSocket};
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);

/// A socket. Each read is one datagram.
pub struct Datagrams(UdpSocket);

impl Datagrams {
    /// Receives on a port of all addresses of this machine.
    pub fn open(port: u16) -> Result<Datagrams> {
        let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, port));
        let socket = socket.and_then(|socket| socket.set_read_timeout(Some(PATIENCE)).map(|()| socket));
        let socket = socket.map_err(|error| {
            SourceError::Busy(format!("UDP port {port} of this machine cannot be listened on: {error}"))
        })?;
        Ok(Datagrams(socket))
    }
}

impl Port for Datagrams {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        use ErrorKind::{Interrupted, TimedOut, WouldBlock};
        match self.0.recv(buffer) {
            Err(error) if matches!(error.kind(), TimedOut | WouldBlock | Interrupted) => Ok(Some(0)),
            read => read.map(Some),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Nobody has said where the device is.
        Ok(bytes.len())
    }
}
