//! A serial port.

use super::Port;
use crate::error::SourceError;
use serialport::{SerialPort, SerialPortInfo};
use std::io::{self, ErrorKind, Read, Write};
use std::time::Duration;

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);

/// Time for which a port has room: Linux keeps 4 KiB, and a board on USB sends some 200 KB a second.
const KEEPS: Duration = Duration::from_millis(10);

/// An open serial port.
pub struct Serial(Box<dyn SerialPort>);

impl Serial {
    /// Opens a port, 8N1.
    pub fn open(path: &str, baud: u32) -> Result<Serial, SourceError> {
        // DTR: a board on USB sends only while the port is open, which it detects by this line.
        let port = serialport::new(path, baud).timeout(PATIENCE).dtr_on_open(true).open();
        port.map(Serial).map_err(|error| fault(path, baud, &error))
    }
}

/// Returns why a port cannot be opened, in plain words.
fn fault(path: &str, baud: u32, error: &serialport::Error) -> SourceError {
    use serialport::ErrorKind::{Io, NoDevice};
    let no_board = |why: &str| SourceError::NoBoard(cannot(path, baud, why));
    match (error.kind(), error.description.as_str()) {
        (NoDevice, _) if !is_missing(path) => busy(path, baud),
        (Io(ErrorKind::PermissionDenied), _) => not_permitted(path, baud),
        (NoDevice | Io(ErrorKind::NotFound), _) => {
            no_board("there is no such port; `taxel ports` lists the ports")
        }
        // The system's message about a file that is not a terminal.
        (_, "Not a typewriter" | "Inappropriate ioctl for device") => no_board("it is not a serial port"),
        (_, stated) => no_board(&stated.to_lowercase()),
    }
}

/// True on Windows, where a port that is not there is reported like one that is open elsewhere, if it is not listed.
fn is_missing(path: &str) -> bool {
    let is_it = |port: SerialPortInfo| port.port_name.eq_ignore_ascii_case(path);
    cfg!(windows) && !serialport::available_ports().unwrap_or_default().into_iter().any(is_it)
}

fn cannot(path: &str, baud: u32, why: &str) -> String {
    format!("serial port {path} at {baud} Bd cannot be opened: {why}")
}

/// The error of a port that another program has open.
pub fn busy(path: &str, baud: u32) -> SourceError {
    SourceError::Busy(cannot(path, baud, "another program has it open"))
}

/// The error of a port that this user may not open, with the command that permits it.
pub(crate) fn not_permitted(path: &str, baud: u32) -> SourceError {
    let why = match cfg!(target_os = "linux") {
        true => format!(
            "this user may not: `sudo usermod -aG {} $USER` permits it, then log in again",
            group(path).as_deref().unwrap_or("dialout")
        ),
        false => "this user may not".into(),
    };
    SourceError::NotPermitted(cannot(path, baud, &why))
}

/// Name of the group of a device, whose members may open it; none if that is root's, or there is no such file.
#[cfg(unix)]
fn group(path: &str) -> Option<String> {
    use std::os::unix::fs::MetadataExt;
    let number = std::fs::metadata(path).ok()?.gid().to_string();
    let groups = std::fs::read_to_string("/etc/group").ok()?;
    let mut known = groups.lines().map(|line| line.split(':'));
    known.find_map(|mut words| {
        let name = words.next()?;
        (words.nth(1)? == number && number != "0").then(|| name.into())
    })
}

#[cfg(not(unix))]
fn group(_: &str) -> Option<String> {
    None
}

impl Port for Serial {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        match self.0.read(buffer) {
            // End of file: the other end has hung up.
            Ok(0) => Ok(None),
            Ok(count) => Ok(Some(count)),
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(Some(0)),
            Err(error) => Err(error),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.write(bytes) {
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(0),
            written => written,
        }
    }

    fn keeps(&self) -> Duration {
        KEEPS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Windows reports both alike; elsewhere this kind of error is that of a port that is open.
    #[test]
    fn a_port_that_is_not_there_is_not_called_busy() {
        let error = serialport::Error::new(serialport::ErrorKind::NoDevice, "");
        let words = if cfg!(windows) { "there is no such port" } else { "another program has it open" };
        let told = fault("COM250", 9600, &error).to_string();
        assert!(told.contains(words), "{told}");
    }
}
