//! Something that speaks, but not a board's wire.

use super::array::{KnownArray, numbers};
use crate::time::Instant;
use std::time::Duration;

/// Bytes that are examined.
const SAMPLE: usize = 16 << 10;
/// Share of a text that may be damaged bytes, in one of so many.
const DAMAGED: usize = 20;

/// Received bytes, as long as none of them is a message of a board.
#[derive(Debug, Default)]
pub struct Stranger {
    /// Time at which the first was received.
    began: Option<Instant>,
    count: u64,
    sample: Vec<u8>,
}

impl Stranger {
    /// Takes received bytes.
    pub fn take(&mut self, bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        self.began.get_or_insert_with(Instant::now);
        self.count += bytes.len() as u64;
        let room = SAMPLE - self.sample.len();
        self.sample.extend_from_slice(&bytes[..room.min(bytes.len())]);
    }

    /// True if nothing was received.
    pub fn is_silent(&self) -> bool {
        self.count == 0
    }

    /// Time since the first bytes.
    pub fn lasts(&self) -> Duration {
        self.began.map_or(Duration::ZERO, |began| began.elapsed())
    }

    /// Describes the bytes of the source with this label: `388,481 bytes of text lines of 252 numbers: no taxel board`,
    /// and says how they are read if they are likely to be an array's.
    pub fn describe(&self, label: &str) -> String {
        let count = grouped(self.count);
        let known = self.known().map_or(String::new(), |known| format!("; {}", known.advice(link(label))));
        let Some(text) = text(&self.sample) else {
            if !known.is_empty() {
                return format!("{label}: {count} bytes: no taxel board{known}");
            }
            let speed = if label.starts_with("serial:") { ", or another speed" } else { "" };
            return format!("{label}: {count} bytes of unknown form: no taxel board{speed}");
        };
        let numbers =
            numbers(text.as_bytes()).map_or(String::new(), |count| format!(" lines of {count} numbers"));
        format!("{label}: {count} bytes of text{numbers}: no taxel board{known}")
    }

    /// The array that the bytes are likely to come from.
    pub fn known(&self) -> Option<KnownArray> {
        KnownArray::of(&self.sample)
    }
}

/// Link of an array in place of a board's source: a port's path, or an address.
fn link(label: &str) -> &str {
    match label.split_once(':') {
        Some(("serial", port)) => port,
        Some(("tcp", _)) => label,
        _ => "PORT",
    }
}

/// The bytes as text; none if they are something else.
fn text(bytes: &[u8]) -> Option<String> {
    let is_text = |byte: &&u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    let damaged = bytes.len() - bytes.iter().filter(is_text).count();
    (damaged * DAMAGED <= bytes.len()).then(|| String::from_utf8_lossy(bytes).into_owned())
}

/// A number with its thousands apart: `388,481`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reported(label: &str, bytes: &[u8]) -> String {
        let mut stranger = Stranger::default();
        bytes.chunks(100).for_each(|piece| stranger.take(piece));
        stranger.describe(label)
    }

    #[test]
    fn what_a_stranger_sends_is_described() {
        let row = (0..252).map(|number| format!("{}", number % 7)).collect::<Vec<_>>().join(",");
        let rows = format!("{row}\r\n").repeat(700);
        assert_eq!(
            reported("tcp:x:1", &rows.as_bytes()[20..]),
            "tcp:x:1: 353,480 bytes of text lines of 252 numbers: no taxel board; `taxel live \
             numbers:tcp:x:1,rows=14,columns=18` reads it as numbers: the shape is a guess, 12 x 21, 9 x 28, 7 x 36 are as many"
        );
        let words = "boot ok\n> 1 2\n".repeat(4);
        assert_eq!(reported("usb:a", words.as_bytes()), "usb:a: 56 bytes of text: no taxel board");
        let noise: Vec<u8> =
            (0..2000u32).map(|number| (number.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        assert_eq!(
            reported("serial:/dev/x@9600", &noise),
            "serial:/dev/x@9600: 2,000 bytes of unknown form: no taxel board, or another speed"
        );
        assert_eq!(grouped(1_234_567), "1,234,567");
    }
}
