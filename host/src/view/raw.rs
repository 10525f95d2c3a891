//! Raw codes for the taxel under the pointer: the board sends them while somebody looks.

use crate::client::Client;
use anyhow::Result;
use std::time::{Duration, Instant};
use taxel_core::wire::Request;

/// Raw codes a second: enough to read a number.
const RATE: u16 = 10;
/// How long nobody looked when the board need not send them any more.
const REST: Duration = Duration::from_secs(10);

/// Whether the board sends raw codes because of us.
#[derive(Debug, Default)]
pub struct RawCodes {
    asked: bool,
    /// Since when nobody looks.
    since: Option<Instant>,
}

impl RawCodes {
    /// Asks the board for what is needed, where something is.
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
