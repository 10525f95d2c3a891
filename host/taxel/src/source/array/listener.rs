//! A port of this machine that a device connects to.

use super::super::Port;
use super::super::tcp::Tcp;
use crate::error::{Result, SourceError};
use crate::time::sleep;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);

/// One device at a time; the next one is accepted once it has gone.
pub struct Listener {
    listener: TcpListener,
    device: Option<Tcp>,
}

impl Listener {
    /// Listens on a port of all addresses of this machine.
    pub fn open(port: u16) -> Result<Listener> {
        let listener = TcpListener::bind((Ipv4Addr::UNSPECIFIED, port));
        let listener = listener.and_then(|listener| listener.set_nonblocking(true).map(|()| listener));
        let listener = listener.map_err(|error| {
            SourceError::Busy(format!("port {port} of this machine cannot be listened on: {error}"))
        })?;
        Ok(Listener { listener, device: None })
    }
}

impl Port for Listener {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        if let Some(device) = &mut self.device {
            match device.read(buffer) {
                Ok(Some(count)) => return Ok(Some(count)),
                Ok(None) | Err(_) => self.device = None,
            }
        }
        match self.listener.accept().and_then(|(stream, _)| Tcp::of(stream)) {
            Ok(device) => self.device = Some(device),
            Err(_) => sleep(PATIENCE),
        }
        Ok(Some(0))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.device.as_mut().map_or(Ok(0), |device| device.write(bytes))
    }
}
