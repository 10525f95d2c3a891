//! A writer with a minimum speed: gives up on clients that read next to nothing for a while.

use std::io::{self, ErrorKind, Write};
use std::time::{Duration, Instant};

/// Least time limit of a response.
const WHILE: Duration = Duration::from_secs(20);
/// Least reading speed, bytes per second, for long responses.
const SLOWEST: u64 = 100_000;
/// Bytes written at once.
const PIECE: usize = 1 << 16;

/// Writes to a stream that has a timeout of its own.
#[derive(Debug)]
pub struct Hurry<W> {
    stream: W,
    begun: Instant,
    written: u64,
}

impl<W: Write> Hurry<W> {
    /// Starts now.
    pub fn new(stream: W) -> Hurry<W> {
        Hurry { stream, begun: Instant::now(), written: 0 }
    }

    /// True if the client has had enough time by `now`.
    fn is_over(&self, now: Instant) -> bool {
        now.saturating_duration_since(self.begun) > WHILE + Duration::from_secs(self.written / SLOWEST)
    }
}

impl<W: Write> Write for Hurry<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.is_over(Instant::now()) {
            return Err(ErrorKind::TimedOut.into());
        }
        let count = self.stream.write(&bytes[..bytes.len().min(PIECE)])?;
        self.written += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_reads_slowly_is_waited_for_as_long_as_it_goes_on() {
        let mut hurry = Hurry::new(Vec::new());
        hurry.write_all(&[0; 3 * PIECE]).unwrap();
        assert_eq!(hurry.stream.len(), 3 * PIECE);
        let after =
            |hurry: &Hurry<Vec<u8>>, seconds| hurry.is_over(hurry.begun + Duration::from_secs(seconds));
        assert!(!after(&hurry, 21) && after(&hurry, 22));
        hurry.written = 100 * SLOWEST;
        assert!(!after(&hurry, 120) && after(&hurry, 121));
    }
}
