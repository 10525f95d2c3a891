//! Access to serial ports, which a test may hand in.

use super::Port;
use super::serial::Serial;
use crate::error::SourceError;
use serialport::SerialPortInfo;
use std::path::Path;

/// Access to serial ports.
pub trait Ports: Send + Sync {
    /// Lists the ports that are there now.
    fn list(&self) -> Vec<SerialPortInfo>;

    /// Opens a port by name, 8N1 at `baud` bits per second. Errors: [`SourceError::NoBoard`] if there is no such
    /// port, [`SourceError::Busy`], [`SourceError::NotPermitted`].
    fn open(&self, name: &str, baud: u32) -> Result<Box<dyn Port>, SourceError>;
}

/// Ports of this machine.
pub struct MachinePorts;

impl Ports for MachinePorts {
    fn list(&self) -> Vec<SerialPortInfo> {
        // serialport panics without this folder.
        if cfg!(target_os = "linux") && !Path::new("/sys/class/tty").is_dir() {
            return Vec::new();
        }
        serialport::available_ports().unwrap_or_default()
    }

    fn open(&self, name: &str, baud: u32) -> Result<Box<dyn Port>, SourceError> {
        Ok(Box::new(Serial::open(name, baud)?))
    }
}
