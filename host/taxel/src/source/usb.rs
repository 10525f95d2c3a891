//! Boards and probes among the serial ports, by their USB ids.

use super::serial_ports::SerialPorts;
use crate::error::SourceError;
use crate::text::words::printable;
use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};

/// USB vendor, product and name of a board. The numbers are for tests (<https://pid.codes>), so other devices
/// may have them, too.
const BOARD: (u16, u16, &str) = (0x1209, 0x0001, "taxel");
/// Vendors of probes that forward a board's UART: Raspberry Pi, Adafruit. General-purpose bridges (FTDI,
/// CP210x, CH34x) are not opened, because opening them restarts some boards.
const PROBES: [u16; 2] = [0x2e8a, 0x239a];
/// Speed of a board's UART, Bd.
pub const BAUD: u32 = 921_600;

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
    /// The kind of this port. The name of a board may be unknown to the system.
    pub fn of(port: &SerialPortInfo) -> PortKind {
        let (vendor, product, name) = BOARD;
        match usb_of(port) {
            Some(usb) if (usb.vid, usb.pid) == (vendor, product) => {
                match usb.product.as_deref().is_none_or(|stated| stated.contains(name)) {
                    true => PortKind::Board,
                    false => PortKind::Other,
                }
            }
            Some(usb) if PROBES.contains(&usb.vid) => PortKind::Probe,
            _ => PortKind::Other,
        }
    }

    /// The kind in words.
    pub fn word(self) -> &'static str {
        match self {
            PortKind::Board => "taxel board",
            PortKind::Probe => "probe",
            PortKind::Other => "other",
        }
    }
}

/// Serial ports: name, kind, and USB description with the serial number.
pub fn listed() -> Vec<(String, PortKind, String)> {
    let describe = |port: SerialPortInfo| {
        let (kind, stated) = (PortKind::of(&port), usb_of(&port).map_or(String::new(), described));
        (port.port_name, kind, stated)
    };
    SerialPorts::default().list().into_iter().map(describe).collect()
}

/// USB description of a port; none if it is not on USB.
pub(crate) fn usb_of(port: &SerialPortInfo) -> Option<&UsbPortInfo> {
    match &port.port_type {
        SerialPortType::UsbPort(usb) => Some(usb),
        _ => None,
    }
}

/// Serial number on USB.
pub(crate) fn serial_of(port: &SerialPortInfo) -> Option<&str> {
    usb_of(port)?.serial_number.as_deref()
}

/// Id, name and serial number of a device, as far as it has them.
fn described(usb: &UsbPortInfo) -> String {
    let stated = [&usb.product, &usb.serial_number].into_iter().flatten().map(|text| printable(text));
    stated.fold(format!("{:04x}:{:04x}", usb.vid, usb.pid), |line, text| format!("{line} {text}"))
}

/// Label of a port; a USB port has no speed.
pub fn label(port: &SerialPortInfo) -> String {
    match PortKind::of(port) {
        PortKind::Board => format!("usb:{}", port.port_name),
        _ => format!("serial:{}@{BAUD}", port.port_name),
    }
}

/// Finds the port of an unplugged device: by its serial number if it has one, else the only port of its kind.
fn back<'a>(lost: &SerialPortInfo, ports: &'a [SerialPortInfo]) -> Option<&'a SerialPortInfo> {
    let known = usb_of(lost)?;
    let is_alike = |usb: &UsbPortInfo| {
        (usb.vid, usb.pid, &usb.serial_number) == (known.vid, known.pid, &known.serial_number)
    };
    let alike: Vec<_> = ports.iter().filter(|port| usb_of(port).is_some_and(is_alike)).collect();
    match alike.as_slice() {
        [one] => Some(one),
        many => many.iter().find(|port| port.port_name == lost.port_name).copied(),
    }
}

/// Description of the port of this name. A name that leads to the port (`/dev/serial/by-id/...`) is not listed, and
/// needs no search when the port comes back.
pub(crate) fn named_port(path: &str, ports: &SerialPorts) -> SerialPortInfo {
    let listed = ports.list().into_iter().find(|port| port.port_name == path);
    listed.unwrap_or_else(|| SerialPortInfo { port_name: path.into(), port_type: SerialPortType::Unknown })
}

/// Finds the port of an unplugged device: the port with the same USB description under any name, or the port with the
/// same name if ports have no description.
pub(crate) fn found_again(lost: &SerialPortInfo, ports: &SerialPorts) -> Result<SerialPortInfo, SourceError> {
    Ok(match usb_of(lost) {
        Some(_) => back(lost, &ports.list())
            .cloned()
            .ok_or_else(|| SourceError::NoBoard("it is not plugged in".into()))?,
        None => lost.clone(),
    })
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
        use PortKind::{Board, Other, Probe};
        let ports = [
            (SerialPortInfo { port_name: "ttyS0".into(), port_type: SerialPortType::PciPort }, Other),
            (port("probe", 0x2e8a, 0x000c, None), Probe),
            (port("bridge", 0x0403, 0x6001, None), Other),
            (port("another", 0x1209, 0x0001, Some("blinker")), Other),
            (port("board", 0x1209, 0x0001, Some("taxel")), Board),
            (port("silent board", 0x1209, 0x0001, None), Board),
        ];
        for (port, kind) in &ports {
            assert_eq!(PortKind::of(port), *kind, "{}", port.port_name);
        }
        assert_eq!(
            ["probe", "board"]
                .map(|name| { label(&ports.iter().find(|(port, _)| port.port_name == name).unwrap().0) }),
            ["serial:probe@921600", "usb:board"]
        );
    }
}
