//! The serial ports of a source's options: those of this machine, unless a test hands in others.

#[cfg(feature = "port-table")]
use super::port_table::PortTable;
use super::ports::{MachinePorts, Ports};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

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
