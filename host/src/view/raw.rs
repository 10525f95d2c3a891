//! Raw codes for the taxel under the pointer: the board sends them while somebody looks.

use crate::client::Client;
use anyhow::Result;
use std::time::{Duration, Instant};
use taxel_core::scene::Scene;

/// Raw codes a second: enough to read a number.
const RATE: u16 = 10;
/// How long nobody looked when the board gets its own scene back.
const REST: Duration = Duration::from_secs(10);

/// Whether the board sends raw codes because of us.
#[derive(Debug, Default)]
pub struct RawCodes {
    /// The scene that was in force before.
    own: Option<Scene>,
    /// When the mode last became wrong.
    since: Option<Instant>,
}

impl RawCodes {
    /// Asks the board for what is needed, where something is.
    pub fn tend(&mut self, client: &mut Client, looked_at: bool, now: Instant) -> Result<()> {
        let Some(worn) = client.worn() else { return Ok(()) };
        let comes = worn.scene.stream.raw_hz > 0;
        // Somebody else's raw codes are left alone.
        let wrong = if looked_at { !comes && self.own.is_none() } else { self.own.is_some() };
        if !wrong {
            self.since = None;
            return Ok(());
        }
        // Another stream touches nothing else on the board: whoever looks need not wait.
        let waited = now.saturating_duration_since(*self.since.get_or_insert(now));
        if !looked_at && waited < REST {
            return Ok(());
        }
        self.since = None;
        let scene = match self.own.take() {
            Some(own) => own,
            None => {
                let own = worn.scene.clone();
                let mut scene = own.clone();
                scene.stream.raw_hz = RATE;
                self.own = Some(own);
                scene
            }
        };
        client.use_for(&scene)
    }
}
