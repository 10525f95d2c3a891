//! Messages of a board that stay valid. A file that continues another begins with them, and so stands alone.

use crate::client::{Client, Event};
use crate::recording::renumbered;
use taxel_core::wire::WireError;

/// Frames of the wire including their 0x00.
#[derive(Debug, Default, Clone)]
pub struct Standing {
    hello: Vec<u8>,
    ill: Vec<Vec<u8>>,
    whole: bool,
}

impl Standing {
    /// Handles an event.
    pub fn take(&mut self, client: &Client, event: &Event) {
        match event {
            Event::Hello => self.hello = client.line().to_vec(),
            Event::HealthMap { whole, .. } => {
                if std::mem::replace(&mut self.whole, *whole) {
                    self.ill.clear();
                }
                self.ill.push(client.line().to_vec());
            }
            _ => {}
        }
    }

    /// Frame of the last `Hello`; empty before the first.
    pub fn hello(&self) -> &[u8] {
        &self.hello
    }

    /// The frames, numbered so that the message with number `next` follows them.
    pub fn frames(&self, next: u32) -> Result<Vec<Vec<u8>>, WireError> {
        let all: Vec<_> = std::iter::once(&self.hello).chain(&self.ill).filter(|f| !f.is_empty()).collect();
        let first = next.wrapping_sub(all.len() as u32);
        all.iter().zip(0u32..).map(|(frame, index)| renumbered(frame, first.wrapping_add(index))).collect()
    }
}
