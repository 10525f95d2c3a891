//! Numbers of the messages in frames of the wire.

use taxel_core::wire::{self, Report, WireError};

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
