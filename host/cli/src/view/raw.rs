//! Requests raw codes from the board while a pointer is on a taxel.

use anyhow::Result;
use std::time::{Duration, Instant};
use taxel::client::Client;
use taxel_core::wire::Request;

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
    pub fn tend(&mut self, client: &mut Client, looked_at: bool, now: Instant) -> Result<()> {
        let Some(worn) = client.worn() else { return Ok(()) };
        let comes = worn.scene.stream.raw_hz > 0;
        if looked_at {
            self.since = None;
            if !comes && !std::mem::replace(&mut self.asked, true) {
                client.request(&Request::SetRaw { hz: RATE })?;
            }
        } else if self.asked && now.saturating_duration_since(*self.since.get_or_insert(now)) >= REST {
            self.asked = false;
            client.request(&Request::SetRaw { hz: 0 })?;
        }
        Ok(())
    }
}
