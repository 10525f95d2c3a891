//! Messages of a board that stay valid. A file that continues another begins with them, and so stands alone.

use crate::client::{Client, Event};
use taxel_core::wire::{self, Report, WireError};

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

/// Frame to be played before `first`, the first frame of the wire in a recording, if the recording's initial
/// `Hello` is lost: `hello`, numbered so that `first` follows it. None if it is not lost, or if either frame
/// is unreadable.
pub fn lost(hello: &[u8], first: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = first.strip_suffix(&[0])?.to_vec();
    let (seq, report): (u32, Report<'_>) = wire::decode(wire::open(&mut bytes).ok()?).ok()?;
    (!matches!(report, Report::Hello(_))).then(|| renumbered(hello, seq.wrapping_sub(1)).ok()).flatten()
}

/// Message number of a frame.
pub fn sequence(frame: &[u8]) -> Result<u32, WireError> {
    let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
    postcard::take_from_bytes(wire::open(&mut bytes)?).map(|(seq, _)| seq).map_err(|_| WireError::Message)
}

/// The frame with another message number.
pub fn renumbered(frame: &[u8], seq: u32) -> Result<Vec<u8>, WireError> {
    let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
    let message = wire::open(&mut bytes)?;
    let (_, report): (u32, Report<'_>) = wire::decode(message)?;
    // A number takes at most 5 bytes.
    let mut out = vec![0; wire::frame_bound(message.len() + 16)];
    Ok(wire::encode(&(seq, report), &mut out)?.to_vec())
}
