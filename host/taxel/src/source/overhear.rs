//! Names what speaks on a port that is no board's, without sending anything.

use super::serial_ports::SerialPorts;
use super::stranger::Stranger;
use crate::text::words;
use crate::time::Instant;
use std::time::Duration;

/// Speeds of arrays, the usual first. A device on USB ignores them.
const SPEEDS: [u32; 5] = [115_200, 2_000_000, 921_600, 250_000, 9_600];
/// Time to listen at each speed.
const LISTEN: Duration = Duration::from_millis(700);

/// Listens to a port at the usual speeds. Returns what speaks there, and how it is read if that is known.
pub fn overheard(name: &str) -> String {
    let (ports, mut unknown) = (SerialPorts::default(), None);
    for baud in SPEEDS {
        let mut port = match ports.open(name, baud) {
            Ok(port) => port,
            Err(why) => return words::sentence(&why),
        };
        let (mut stranger, mut buffer, began) = (Stranger::default(), [0; 4096], Instant::now());
        while began.elapsed() < LISTEN {
            match port.read(&mut buffer) {
                Ok(Some(count)) => stranger.take(&buffer[..count]),
                Ok(None) | Err(_) => break,
            }
        }
        let said = || stranger.describe(&format!("serial:{name}@{baud}"));
        if stranger.known().is_some() {
            return said();
        }
        if !stranger.is_silent() {
            unknown.get_or_insert_with(said);
        }
    }
    unknown.unwrap_or_else(|| format!("{name} is silent at {SPEEDS:?} Bd"))
}
