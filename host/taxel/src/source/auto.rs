//! Opens the board that is plugged in: on USB, else behind a probe. It is listened to first, without sending
//! anything, so that what is opened is a board that speaks.

use super::heard::Heard;
use super::serial_ports::SerialPorts;
use super::stranger::Stranger;
use super::usb::{BAUD, PortKind, found_again, label, named_port, serial_of};
use super::{Source, SourceOptions};
use crate::client::{Client, Event};
use crate::error::{Error, Result, SourceError};
use crate::text::words::printable;
use crate::time::Instant;
use serialport::SerialPortInfo;
use std::thread;
use std::time::Duration;

/// Time to listen on a port: a board that does not stream sends a `Hello` each second.
const LISTEN: Duration = Duration::from_millis(1500);

/// Opens the board that is plugged in on USB; with `probes`, if there is none, the board behind a probe.
pub fn plugged(probes: bool, options: &SourceOptions) -> Result<Source> {
    let (mut found, forwarded) = candidates(&options.ports);
    if found.is_empty() && probes {
        found = forwarded;
    }
    if found.is_empty() {
        let or_probe = if probes { ", or of a probe" } else { "" };
        fail!(
            SourceError::NoBoard,
            "no board is plugged in: no serial port has the USB id of a board, 1209:0001{or_probe}"
        );
    }
    choose(found, options)
}

/// Opens the board with this serial number on USB, or behind the probe with this number.
pub fn numbered(number: &str, options: &SourceOptions) -> Result<Source> {
    let (mut all, probes) = candidates(&options.ports);
    all.extend(probes);
    let found: Vec<_> = all.iter().filter(|port| serial_of(port) == Some(number)).cloned().collect();
    if found.is_empty() {
        let named = |port: &SerialPortInfo| format!("{} on {}", number_of(port), port.port_name);
        let there = match all.len() {
            0 => "none is plugged in".into(),
            _ => format!("there are {}", all.iter().map(named).collect::<Vec<_>>().join(", ")),
        };
        fail!(SourceError::NoBoard, "no board on USB has the serial number {number}: {there}");
    }
    choose(found, options)
}

/// Opens a serial port by name.
pub fn port(path: &str, baud: u32, options: &SourceOptions) -> Result<Source> {
    let link = Heard::new(options.ports.open(path, baud)?, Vec::new());
    let port = named_port(path, &options.ports);
    Ok(named(format!("serial:{path}@{baud}"), port, link, baud, &options.ports))
}

/// Boards on USB, and probes that may forward a board's UART.
fn candidates(ports: &SerialPorts) -> (Vec<SerialPortInfo>, Vec<SerialPortInfo>) {
    let known = ports.list().into_iter().filter(|port| PortKind::of(port) != PortKind::Other);
    known.partition(|port| PortKind::of(port) == PortKind::Board)
}

/// Opens the only board on these ports; the first one, if that is what the caller wants of several.
fn choose(found: Vec<SerialPortInfo>, options: &SourceOptions) -> Result<Source> {
    // A board on USB counts even if it is busy: it may be the one that is meant.
    let mut boards: Vec<_> =
        found.iter().filter(|port| PortKind::of(port) == PortKind::Board).cloned().collect();
    refuse_several(&boards, options)?;
    let heard: Vec<_> = thread::scope(|scope| {
        let begun: Vec<_> =
            found.iter().map(|port| scope.spawn(move || listen(port, &options.ports))).collect();
        let ended = || Err(SourceError::Silent("its thread ended".into()));
        begun.into_iter().map(|thread| thread.join().unwrap_or_else(|_| ended())).collect()
    });
    let (mut speaking, mut faults) = (Vec::new(), Vec::new());
    for (port, heard) in found.iter().zip(heard) {
        match heard {
            Ok(link) => speaking.push((port, link)),
            Err(fault) => faults.push(fault),
        }
    }
    if boards.is_empty() {
        boards.extend(speaking.iter().map(|(port, _)| (*port).clone()));
        refuse_several(&boards, options)?;
    }
    let Some((port, link)) = speaking.into_iter().next() else { return Err(worst(faults)) };
    let others = boards.iter().filter(|other| *other != port).map(|other| name(other, &boards)).collect();
    Ok(Source { others, ..named(label(port), port.clone(), link, BAUD, &options.ports) })
}

fn refuse_several(boards: &[SerialPortInfo], options: &SourceOptions) -> Result<()> {
    if boards.len() < 2 || options.first {
        return Ok(());
    }
    let names: Vec<_> = boards.iter().map(|board| name(board, boards)).collect();
    let names = names.join(", ");
    fail!(SourceError::SeveralBoards, "{} boards are plugged in: name one of {names}", boards.len())
}

/// Name of the source that opens this board and no other one of these, and its port.
fn name(port: &SerialPortInfo, among: &[SerialPortInfo]) -> String {
    let number = serial_of(port);
    match number.filter(|_| among.iter().filter(|other| serial_of(other) == number).count() == 1) {
        Some(number) => format!("usb:{} ({})", printable(number), port.port_name),
        None => format!("serial:{}", port.port_name),
    }
}

fn number_of(port: &SerialPortInfo) -> String {
    serial_of(port).map_or("one without a number".into(), |number| printable(number).into_owned())
}

/// All faults as one error; of its kind is the fault that needs the user's action first.
fn worst(faults: Vec<SourceError>) -> Error {
    let reported = faults.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    let any = |is: fn(&SourceError) -> bool| faults.iter().any(is);
    let kind = match () {
        () if any(|fault| matches!(fault, SourceError::NotPermitted(_))) => SourceError::NotPermitted,
        () if any(|fault| matches!(fault, SourceError::Busy(_))) => SourceError::Busy,
        () if any(|fault| matches!(fault, SourceError::Foreign(_))) => SourceError::Foreign,
        () => SourceError::Silent,
    };
    kind(reported).into()
}

/// A board on this port with this label, which changes if it comes back on another port.
fn named(label: String, port: SerialPortInfo, link: Heard, baud: u32, ports: &SerialPorts) -> Source {
    let usb_serial = serial_of(&port).map(String::from);
    let ports = ports.clone();
    Source { usb_serial, ..Source::real(label, link, move || returned(&port, &ports, baud)) }
}

/// Opens the port of an unplugged board.
fn returned(lost: &SerialPortInfo, ports: &SerialPorts, baud: u32) -> Result<Source> {
    let found = found_again(lost, ports)?;
    let link = Heard::new(ports.open(&found.port_name, baud)?, Vec::new());
    let label = match PortKind::of(&found) {
        PortKind::Board => label(&found),
        _ => format!("serial:{}@{baud}", found.port_name),
    };
    Ok(named(label, found, link, baud, ports))
}

/// Opens a port, and returns it with the bytes heard once a board sends on it: a `Hello`, or anything that it
/// still streams to an earlier program.
fn listen(port: &SerialPortInfo, ports: &SerialPorts) -> Result<Heard, SourceError> {
    let label = label(port);
    log::info!("listening for a board on {label}");
    let mut link = ports.open(&port.port_name, BAUD)?;
    let (mut client, mut heard, mut stranger) = (Client::new(), Vec::new(), Stranger::default());
    let (mut buffer, begun) = ([0; 1024], Instant::now());
    while begun.elapsed() < LISTEN {
        let read =
            link.read(&mut buffer).map_err(|error| SourceError::Silent(format!("{label}: {error}")))?;
        let Some(count) = read else { break };
        heard.extend_from_slice(&buffer[..count]);
        stranger.take(&buffer[..count]);
        for event in buffer[..count].iter().filter_map(|byte| client.push(*byte)) {
            match event {
                Event::Refused(_) => {}
                Event::Unusable(why) => return Err(SourceError::Foreign(format!("{label}: {why}"))),
                _ => return Ok(Heard::new(link, heard)),
            }
        }
    }
    Err(match stranger.is_silent() {
        true => SourceError::Silent(format!(
            "{label} is silent: it sends no Hello of a taxel board in {} s",
            LISTEN.as_secs_f64()
        )),
        false => SourceError::Foreign(stranger.describe(&label)),
    })
}
