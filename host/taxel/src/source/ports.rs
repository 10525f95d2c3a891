//! Serial ports: those of this machine, or those that a test hands in.

use super::Port;
#[cfg(feature = "port-table")]
use super::port_table::PortTable;
use super::serial::Serial;
use crate::error::SourceError;
use serialport::SerialPortInfo;
use std::fmt;
use std::ops::Deref;
use std::path::Path;
use std::sync::Arc;

/// Access to serial ports.
pub trait Ports: Send + Sync {
    /// Lists the ports that are there now.
    fn list(&self) -> Vec<SerialPortInfo>;

    /// Opens a port by name, 8N1 at `baud` bits per second. Errors: [`SourceError::NoBoard`] if there is no such
    /// port, [`SourceError::Busy`], [`SourceError::NotPermitted`].
    fn open(&self, name: &str, baud: u32) -> Result<Box<dyn Port>, SourceError>;
}

/// Shared access to serial ports; by default those of this machine.
#[derive(Clone)]
pub struct SerialPorts(Arc<dyn Ports>);

impl SerialPorts {
    /// Access to these ports.
    pub fn new(ports: impl Ports + 'static) -> SerialPorts {
        SerialPorts(Arc::new(ports))
    }
}

impl Default for SerialPorts {
    fn default() -> SerialPorts {
        #[cfg(feature = "port-table")]
        if let Some(table) = PortTable::of_environment() {
            return SerialPorts::new(table);
        }
        SerialPorts::new(MachinePorts)
    }
}

impl Deref for SerialPorts {
    type Target = dyn Ports;

    fn deref(&self) -> &Self::Target {
        self.0.as_ref()
    }
}

impl fmt::Debug for SerialPorts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SerialPorts")
    }
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
