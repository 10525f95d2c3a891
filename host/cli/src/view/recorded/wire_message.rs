//! The message of the wire in a piece of a recording.

use taxel::recording::ClipMessage;
use taxel_core::wire::{self, Report};

/// Decodes a message; none if it cannot be read.
pub fn with_report<T>(piece: &ClipMessage, read: impl FnOnce(u32, &Report<'_>) -> T) -> Option<T> {
    let mut bytes = piece.data.strip_suffix(&[0]).unwrap_or(&piece.data).to_vec();
    let (seq, report) = wire::decode::<(u32, Report<'_>)>(wire::open(&mut bytes).ok()?).ok()?;
    Some(read(seq, &report))
}
