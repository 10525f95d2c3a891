//! Finds a real board by its USB id, or by listening on a probe's port; else simulates one.

use super::serial::Serial;
use super::{Port, Source, SourceOptions, SourceSpec, open as open_source};
use crate::client::{Client, Event};
use crate::error::{Result, SourceError};
use crate::tell::verbose;
use crate::tell::words::printable;
use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};
use std::path::Path;
use std::time::{Duration, Instant};

/// USB vendor, product and name of a board. The numbers are for tests (<https://pid.codes>), so other devices
/// may have them, too.
const BOARD: (u16, u16, &str) = (0x1209, 0x0001, "taxel");
/// Vendors of probes that forward a board's UART: Raspberry Pi, Adafruit. General-purpose bridges (FTDI,
/// CP210x, CH34x) are not opened, because opening them restarts some boards.
const PROBES: [u16; 2] = [0x2e8a, 0x239a];
/// Time to listen on a port, without sending anything.
const LISTEN: Duration = Duration::from_millis(1500);
const BAUD: u32 = 921_600;

/// Opens the first port on which a board is found.
pub fn open(options: &SourceOptions) -> Result<Source> {
    let known = known(ports());
    let mut silent = Vec::new();
    for port in &known {
        verbose::tell(format_args!("listening for a board on {}", port.port_name));
        match Serial::open(&port.port_name, BAUD) {
            Ok(serial) => {
                if let Some(serial) = listen(serial) {
                    return Ok(real(port, serial, BAUD));
                }
                silent.push(format!("no Hello on {}", port.port_name));
            }
            Err(error) => silent.push(error.to_string()),
        }
    }
    let simulation = SourceSpec::simulation();
    let why = match silent.len() {
        0 => "no serial port has the USB id of a board, 1209:0001, or of a probe".into(),
        _ => silent.join(", "),
    };
    eprintln!("No board found ({why}): simulating one, as --source {simulation} does.");
    open_source(&simulation, options)
}

/// Opens the first USB board whose port is not in use.
pub fn usb() -> Result<Source> {
    let (mut boards, mut why) = (known(ports()), Vec::new());
    boards.retain(|port| usb_of(port).is_some_and(is_board));
    for port in &boards {
        match Serial::open(&port.port_name, BAUD) {
            Ok(serial) => return Ok(real(port, serial, BAUD)),
            Err(error) => why.push(error.to_string()),
        }
    }
    let (vendor, product, name) = BOARD;
    match why.len() {
        0 => fail!(
            SourceError::NoBoard,
            "no board on USB: no serial port has the id {vendor:04x}:{product:04x} {name}"
        ),
        _ => fail!(SourceError::NoBoard, "no board on USB can be used: {}", why.join(", ")),
    }
}

/// Opens the board with this serial number on USB; with `probes` also the probe with this number that
/// forwards a board's UART.
pub fn numbered(number: &str, probes: bool) -> Result<Source> {
    let mut ports = known(ports());
    ports.retain(|port| probes || usb_of(port).is_some_and(is_board));
    let of = |port: &SerialPortInfo| usb_of(port).and_then(|usb| usb.serial_number.clone());
    let Some(port) = ports.iter().find(|port| of(port).as_deref() == Some(number)) else {
        let there = ports.iter().map(|port| {
            let its = of(port).map_or("without a number".into(), |number| printable(&number).into_owned());
            format!("{} on {}", its, port.port_name)
        });
        let there = match ports.len() {
            0 => "none is plugged in".into(),
            _ => format!("there are {}", there.collect::<Vec<_>>().join(", ")),
        };
        fail!(SourceError::NoBoard, "no board on USB has the serial number {number}: {there}");
    };
    Ok(real(port, Serial::open(&port.port_name, BAUD)?, BAUD))
}

/// Opens a serial port by name.
pub fn port(path: &str, baud: u32) -> Result<Source> {
    let serial = Serial::open(path, baud)?;
    // A name that leads to the port (`/dev/serial/by-id/...`) is not listed, and needs no search when the
    // port comes back.
    let listed = ports().into_iter().find(|port| port.port_name == path);
    let port = listed.unwrap_or_else(|| SerialPortInfo {
        port_name: path.into(),
        port_type: serialport::SerialPortType::Unknown,
    });
    Ok(named(format!("serial:{path}@{baud}"), port, serial, baud))
}

/// A board on this port.
fn real(port: &SerialPortInfo, serial: Serial, baud: u32) -> Source {
    named(label(port), port.clone(), serial, baud)
}

/// A board on this port with this label, which changes if it comes back on another port.
fn named(label: String, port: SerialPortInfo, serial: Serial, baud: u32) -> Source {
    let usb_serial = usb_of(&port).and_then(|usb| usb.serial_number.clone());
    Source { usb_serial, ..Source::real(label, serial, move || returned(&port, ports(), baud)) }
}

/// Opens the port of an unplugged board: the port with the same USB description under any name, or the port
/// with the same name if ports have no description.
fn returned(lost: &SerialPortInfo, ports: Vec<SerialPortInfo>, baud: u32) -> Result<Source> {
    let found = match usb_of(lost) {
        Some(_) => back(lost, &ports).ok_or_else(|| SourceError::NoBoard("it is not plugged in".into()))?,
        None => lost,
    };
    let serial = Serial::open(&found.port_name, baud)?;
    let label = if usb_of(found).is_some_and(is_board) {
        label(found)
    } else {
        format!("serial:{}@{baud}", found.port_name)
    };
    Ok(named(label, found.clone(), serial, baud))
}

/// Finds the port of an unplugged device: by its serial number if it has one, else the only port of its kind.
fn back<'a>(lost: &SerialPortInfo, ports: &'a [SerialPortInfo]) -> Option<&'a SerialPortInfo> {
    let known = usb_of(lost)?;
    let alike: Vec<_> = ports
        .iter()
        .filter(|port| {
            usb_of(port).is_some_and(|usb| {
                (usb.vid, usb.pid, &usb.serial_number) == (known.vid, known.pid, &known.serial_number)
            })
        })
        .collect();
    match alike.as_slice() {
        [one] => Some(one),
        many => many.iter().find(|port| port.port_name == lost.port_name).copied(),
    }
}

/// Kind of device behind a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PortKind {
    /// A board, by its USB id.
    Board,
    /// A probe that may forward a board's UART.
    Probe,
    /// Anything else.
    Other,
}

impl PortKind {
    /// The kind in words.
    pub fn word(self) -> &'static str {
        match self {
            PortKind::Board => "taxel board",
            PortKind::Probe => "probe",
            PortKind::Other => "other",
        }
    }
}

/// Serial ports of this machine: name, kind, and USB description with the serial number.
pub fn listed() -> Vec<(String, PortKind, String)> {
    let describe = |port: SerialPortInfo| {
        let Some(usb) = usb_of(&port) else { return (port.port_name, PortKind::Other, String::new()) };
        let kind = match is_board(usb) {
            true => PortKind::Board,
            false if PROBES.contains(&usb.vid) => PortKind::Probe,
            false => PortKind::Other,
        };
        let told = described(usb);
        (port.port_name, kind, told)
    };
    ports().into_iter().map(describe).collect()
}

/// Id, name and serial number of a device, as far as it has them.
fn described(usb: &UsbPortInfo) -> String {
    let told = [&usb.product, &usb.serial_number].into_iter().flatten().map(|text| printable(text));
    told.fold(format!("{:04x}:{:04x}", usb.vid, usb.pid), |line, text| format!("{line} {text}"))
}

/// All serial ports of this machine.
fn ports() -> Vec<SerialPortInfo> {
    // serialport panics without this folder.
    if cfg!(target_os = "linux") && !Path::new("/sys/class/tty").is_dir() {
        return Vec::new();
    }
    // A system without serial ports may report an error.
    serialport::available_ports().unwrap_or_default()
}

/// Ports that may have a board, boards first.
fn known(ports: Vec<SerialPortInfo>) -> Vec<SerialPortInfo> {
    let (boards, others): (Vec<_>, Vec<_>) =
        ports.into_iter().partition(|port| usb_of(port).is_some_and(is_board));
    let probes = others.into_iter().filter(|port| usb_of(port).is_some_and(|usb| PROBES.contains(&usb.vid)));
    boards.into_iter().chain(probes).collect()
}

fn usb_of(port: &SerialPortInfo) -> Option<&UsbPortInfo> {
    match &port.port_type {
        SerialPortType::UsbPort(usb) => Some(usb),
        _ => None,
    }
}

/// The name may be unknown to the system.
fn is_board(usb: &UsbPortInfo) -> bool {
    let (vendor, product, name) = BOARD;
    (usb.vid, usb.pid) == (vendor, product) && usb.product.as_deref().is_none_or(|told| told.contains(name))
}

/// Label of a port; a USB port has no speed.
fn label(port: &SerialPortInfo) -> String {
    match usb_of(port).is_some_and(is_board) {
        true => format!("usb:{}", port.port_name),
        false => format!("serial:{}@{BAUD}", port.port_name),
    }
}

/// Returns the port, with the bytes heard, if a board sends on it: a `Hello`, or anything that it still
/// streams to an earlier program.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn port(name: &str, vid: u16, pid: u16, product: Option<&str>) -> SerialPortInfo {
        let product = product.map(String::from);
        let usb = UsbPortInfo { vid, pid, serial_number: None, manufacturer: None, product };
        SerialPortInfo { port_name: name.into(), port_type: SerialPortType::UsbPort(usb) }
    }

    #[test]
    fn a_board_that_is_plugged_in_again_is_found_under_another_name() {
        let with = |mut port: SerialPortInfo, number: &str| {
            if let SerialPortType::UsbPort(usb) = &mut port.port_type {
                usb.serial_number = Some(number.into());
            }
            port
        };
        let board = |name: &str| port(name, 0x1209, 0x0001, Some("taxel"));
        let found = |lost: &SerialPortInfo, ports: &[SerialPortInfo]| {
            back(lost, ports).map(|port| port.port_name.clone())
        };
        let lost = with(board("ttyACM0"), "A1");
        assert_eq!(usb_of(&lost).map(described).as_deref(), Some("1209:0001 taxel A1"));
        let other = with(board("ttyACM0"), "B2");
        assert_eq!(found(&lost, std::slice::from_ref(&other)), None, "another board has taken its name");
        assert_eq!(found(&lost, &[other, with(board("ttyACM3"), "A1")]).as_deref(), Some("ttyACM3"));
        // Boards without a serial number: the only one, or the one with the same name.
        assert_eq!(found(&board("ttyACM0"), &[board("ttyACM1")]).as_deref(), Some("ttyACM1"));
        let two = [board("ttyACM1"), board("ttyACM0")];
        assert_eq!(found(&board("ttyACM0"), &two).as_deref(), Some("ttyACM0"));
        assert_eq!(found(&board("ttyACM7"), &two), None);
        let plain = SerialPortInfo { port_name: "ttyS0".into(), port_type: SerialPortType::PciPort };
        assert_eq!(found(&plain, std::slice::from_ref(&plain)), None, "it is opened by its name");
    }

    #[test]
    fn a_board_is_known_by_its_usb_id_and_name() {
        let ports = vec![
            SerialPortInfo { port_name: "ttyS0".into(), port_type: SerialPortType::PciPort },
            port("probe", 0x2e8a, 0x000c, None),
            port("bridge", 0x0403, 0x6001, None),
            port("another", 0x1209, 0x0001, Some("blinker")),
            port("board", 0x1209, 0x0001, Some("taxel")),
            port("silent board", 0x1209, 0x0001, None),
        ];
        let found = known(ports);
        let labels: Vec<_> = found.iter().map(label).collect();
        assert_eq!(labels, ["usb:board", "usb:silent board", "serial:probe@921600"]);
    }
}
