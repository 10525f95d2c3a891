//! Requests raw codes from the board while a pointer is on a taxel.

use std::time::Duration;
use taxel::client::Client;
use taxel::time::Instant;

/// Raw codes per second: enough to read a number.
const RATE: u16 = 10;
/// Time without a pointer on a taxel after which raw codes are stopped.
const REST: Duration = Duration::from_secs(10);

/// Raw codes requested by the page.
#[derive(Debug, Default)]
pub struct RawCodes {
    asked: bool,
    /// Since when no pointer is on a taxel.
    since: Option<Instant>,
}

impl RawCodes {
    /// Starts or stops raw codes as needed.
    pub fn tend(&mut self, client: &mut Client, looked_at: bool, now: Instant) -> taxel::Result<()> {
        if client.description().is_none() {
            return Ok(());
        }
        if looked_at {
            self.since = None;
            if client.raw_hz() == 0 {
                self.asked = true;
                client.stream_raw(RATE)?;
            }
        } else if self.asked && now.saturating_duration_since(*self.since.get_or_insert(now)) >= REST {
            self.asked = false;
            client.stream_raw(0)?;
        }
        Ok(())
    }
}
