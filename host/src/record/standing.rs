//! What a board said once and what holds since: a file that goes on another begins with it, and so stands
//! alone.

use crate::client::{Client, Event};
use taxel_core::wire::{self, Report, WireError};

/// Frames of the wire, their 0x00 included.
#[derive(Debug, Default, Clone)]
pub struct Standing {
    hello: Vec<u8>,
    ill: Vec<Vec<u8>>,
    whole: bool,
}

impl Standing {
    /// Takes what came.
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

    /// The last `Hello`; empty before the first.
    pub fn hello(&self) -> &[u8] {
        &self.hello
    }

    /// The frames, numbered so that the message of the number `next` follows them.
    pub fn frames(&self, next: u32) -> Result<Vec<Vec<u8>>, WireError> {
        let all: Vec<_> = std::iter::once(&self.hello).chain(&self.ill).filter(|f| !f.is_empty()).collect();
        let first = next.wrapping_sub(all.len() as u32);
        all.iter().zip(0u32..).map(|(frame, index)| renumbered(frame, first.wrapping_add(index))).collect()
    }
}

/// What is to be played before `first`, the first frame of the wire that a recording holds, if the one that
/// it began with is lost: `hello`, numbered so that `first` follows it. None: it is not lost, or one of them
/// cannot be read.
pub fn lost(hello: &[u8], first: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = first.strip_suffix(&[0])?.to_vec();
    let (seq, report): (u32, Report<'_>) = wire::decode(wire::open(&mut bytes).ok()?).ok()?;
    (!matches!(report, Report::Hello(_))).then(|| renumbered(hello, seq.wrapping_sub(1)).ok()).flatten()
}

/// The number of a frame's message.
pub fn sequence(frame: &[u8]) -> Result<u32, WireError> {
    let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
    postcard::take_from_bytes(wire::open(&mut bytes)?).map(|(seq, _)| seq).map_err(|_| WireError::Message)
}

/// A frame of the wire, its message under another number.
pub fn renumbered(frame: &[u8], seq: u32) -> Result<Vec<u8>, WireError> {
    let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
    let message = wire::open(&mut bytes)?;
    let (_, report): (u32, Report<'_>) = wire::decode(message)?;
    // A number takes 5 bytes at most.
    let mut out = vec![0; wire::frame_bound(message.len() + 16)];
    Ok(wire::encode(&(seq, report), &mut out)?.to_vec())
}
