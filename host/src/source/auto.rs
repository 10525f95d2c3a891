//! A real board, if there is one, else a simulated one.

use super::serial::Serial;
use super::{Port, Source, SourceOptions, SourceSpec, open as open_source};
use crate::client::{Client, Event};
use anyhow::Result;
use serialport::{SerialPortInfo, SerialPortType};
use std::time::{Duration, Instant};

/// USB vendors whose boards may run the firmware: Raspberry Pi, Adafruit. Bridges that sit in front of anything (FTDI,
/// CP210x, CH34x) are not opened, because opening them restarts some boards.
const VENDORS: [u16; 2] = [0x2e8a, 0x239a];
/// How long a port is listened to, without a byte being sent.
const LISTEN: Duration = Duration::from_millis(1500);
const BAUD: u32 = 921_600;

/// Opens the first port on which a board is heard.
pub fn open(options: &SourceOptions) -> Result<Source> {
    // A system without serial ports may say so by an error.
    let ports = serialport::available_ports().unwrap_or_default();
    let known: Vec<_> = ports.into_iter().filter(is_known).collect();
    let mut silent = Vec::new();
    for port in &known {
        match Serial::open(&port.port_name, BAUD) {
            Ok(serial) => {
                if let Some(serial) = listen(serial) {
                    return Ok(Source::real(format!("serial:{}@{BAUD}", port.port_name), serial));
                }
                silent.push(format!("{} says no Hello", port.port_name));
            }
            Err(error) => silent.push(error.to_string()),
        }
    }
    let simulation = SourceSpec::simulation();
    let why = match silent.len() {
        0 => "no serial port has the USB id of a known board".into(),
        _ => silent.join(", "),
    };
    eprintln!("No board found ({why}): simulating one, as --source {simulation} does.");
    open_source(&simulation, options)
}

fn is_known(port: &SerialPortInfo) -> bool {
    matches!(&port.port_type, SerialPortType::UsbPort(usb) if VENDORS.contains(&usb.vid))
}

/// The port, with what was heard, if a board speaks there: `Hello`, or whatever it still streams to somebody before.
fn listen(mut serial: Serial) -> Option<Serial> {
    let begun = Instant::now();
    let (mut client, mut heard, mut buffer) = (Client::new(), Vec::new(), [0; 1024]);
    while begun.elapsed() < LISTEN {
        let count = serial.read(&mut buffer).ok()??;
        heard.extend_from_slice(&buffer[..count]);
        let events: Vec<_> = buffer[..count].iter().filter_map(|byte| client.push(*byte)).collect();
        if events.iter().any(|event| !matches!(event, Event::Refused(_) | Event::Unusable(_))) {
            serial.unread(heard);
            return Some(serial);
        }
    }
    None
}
