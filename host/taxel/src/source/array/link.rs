//! The link of an array: a serial port, the network, a file, the standard input.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// Source of an array's bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ArrayLink {
    /// A serial port.
    Serial {
        /// The device.
        path: String,
        /// Bits per second; none for the format's.
        baud: Option<u32>,
    },
    /// `HOST:PORT`, to connect to.
    Tcp(String),
    /// A port of this machine that the device connects to.
    Listen(u16),
    /// A port of this machine that the device sends datagrams to.
    Udp(u16),
    /// A file of the bytes, or a recording (`.mcap`, `.mcap#BOARD`) of what was perceived in them.
    File(PathBuf),
    /// The standard input.
    Stdin,
}

impl FromStr for ArrayLink {
    type Err = String;

    fn from_str(text: &str) -> Result<ArrayLink, String> {
        let port = |port: &str| {
            let number = port.parse::<u16>().ok().filter(|number| *number > 0);
            number.ok_or(format!("\"{port}\" must be a port number of 1 to 65535"))
        };
        match text.split_once(':') {
            None if text == "-" => return Ok(ArrayLink::Stdin),
            Some(("tcp", address)) => match address.rsplit_once(':') {
                Some((host, number)) if !host.is_empty() => {
                    port(number)?;
                    return Ok(ArrayLink::Tcp(address.into()));
                }
                _ => return Err("tcp:HOST:PORT needs a host and a port".into()),
            },
            Some(("listen", number)) => return port(number).map(ArrayLink::Listen),
            Some(("udp", number)) => return port(number).map(ArrayLink::Udp),
            Some(("file", path)) if !path.is_empty() => return Ok(ArrayLink::File(path.into())),
            _ => {}
        }
        let (path, baud) = match text.rsplit_once('@') {
            Some((path, baud)) => {
                let number = baud.parse().ok().filter(|baud| *baud > 0);
                (
                    path,
                    Some(
                        number
                            .ok_or(format!("PORT@BAUD needs a number of bits per second, not \"{baud}\""))?,
                    ),
                )
            }
            None => (text, None),
        };
        let is_com =
            path.strip_prefix("COM").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
        if path.starts_with('/') || is_com {
            return Ok(ArrayLink::Serial { path: path.into(), baud });
        }
        Err(format!(
            "\"{text}\" is no link: known are a serial port (/dev/ttyUSB0 or COM5, with @BAUD), tcp:HOST:PORT, \
             listen:PORT, udp:PORT, file:PATH and - for the standard input"
        ))
    }
}

impl fmt::Display for ArrayLink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ArrayLink::Serial { path, baud: None } => f.write_str(path),
            ArrayLink::Serial { path, baud: Some(baud) } => write!(f, "{path}@{baud}"),
            ArrayLink::Tcp(address) => write!(f, "tcp:{address}"),
            ArrayLink::Listen(port) => write!(f, "listen:{port}"),
            ArrayLink::Udp(port) => write!(f, "udp:{port}"),
            ArrayLink::File(path) => write!(f, "file:{}", path.display()),
            ArrayLink::Stdin => f.write_str("-"),
        }
    }
}
