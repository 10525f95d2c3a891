//! Serial ports that a file lists in place of this machine's: how tests of the program and of the Python package
//! plug boards in. No released program has it.
//!
//! ```toml
//! [[port]]
//! name = "/dev/ttyACM0"
//! usb = [0x1209, 0x0001]
//! product = "taxel"
//! serial = "A1"
//! opens = "/dev/pts/3"    # a port of this machine; or "hung", "busy", "not permitted"
//! ```

use super::Port;
use super::ports::{MachinePorts, Ports};
use super::serial;
use crate::error::SourceError;
use crate::time::sleep;
use serde::Deserialize;
use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};
use std::io;
use std::path::PathBuf;
use std::time::Duration;

/// Ports of a file, which is read anew each time.
pub struct PortTable(PathBuf);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedPorts {
    #[serde(default)]
    port: Vec<ListedPort>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedPort {
    name: String,
    usb: Option<[u16; 2]>,
    product: Option<String>,
    serial: Option<String>,
    opens: String,
}

impl PortTable {
    /// The file that TAXEL_PORTS names; none if it is not set.
    pub(crate) fn of_environment() -> Option<PortTable> {
        std::env::var_os("TAXEL_PORTS").map(|path| PortTable(path.into()))
    }

    /// Ends the program if the file is wrong: a test that goes on would test nothing.
    fn rows(&self) -> Vec<ListedPort> {
        let text = std::fs::read_to_string(&self.0).map_err(|error| error.to_string());
        let table =
            text.and_then(|text| toml::from_str::<ListedPorts>(&text).map_err(|error| error.to_string()));
        table.map(|table| table.port).unwrap_or_else(|why| {
            log::error!("TAXEL_PORTS: {}: {why}", self.0.display());
            std::process::exit(70)
        })
    }
}

impl Ports for PortTable {
    fn list(&self) -> Vec<SerialPortInfo> {
        let port = |row: ListedPort| {
            let usb = |[vid, pid]: [u16; 2]| UsbPortInfo {
                vid,
                pid,
                serial_number: row.serial,
                manufacturer: None,
                product: row.product,
            };
            let port_type = row.usb.map(usb).map_or(SerialPortType::Unknown, SerialPortType::UsbPort);
            SerialPortInfo { port_name: row.name, port_type }
        };
        self.rows().into_iter().map(port).collect()
    }

    fn open(&self, name: &str, baud: u32) -> Result<Box<dyn Port>, SourceError> {
        let row = self.rows().into_iter().find(|row| row.name == name);
        let opens = row.map_or(name.to_string(), |row| row.opens);
        match opens.as_str() {
            "hung" => Ok(Box::new(Hung)),
            "busy" => Err(serial::busy(name, baud)),
            "not permitted" => Err(serial::not_permitted(name, baud)),
            path => MachinePorts.open(path, baud),
        }
    }
}

/// A port that opens, and neither says nor reads anything.
struct Hung;

impl Port for Hung {
    fn read(&mut self, _: &mut [u8]) -> io::Result<Option<usize>> {
        sleep(Duration::from_millis(10));
        Ok(Some(0))
    }

    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Ok(0)
    }
}
