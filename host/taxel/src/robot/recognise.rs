//! Recognises a board before anything is asked of it: its bytes go nowhere until its `Hello` is the right
//! one.

use crate::client::{Client, Event, Identity};
use crate::error::{Result, SourceError};
use crate::source::{Heard, Source, Stranger};
use crate::time::Instant;
use std::time::Duration;
use taxel_core::wire::{Request, encode, frame_bound};

/// Longest wait for a `Hello`: a board that does not stream sends one each second.
const PATIENCE: Duration = Duration::from_secs(3);
/// Bytes read at a time.
const PIECE: usize = 4096;

/// Opens a source for the first time: asks for a `Hello`, and compares it. The bytes read meanwhile are read again.
/// Simulations and recordings, which do not run in real time, are recognised by their session, as is a board that
/// returns: their first bytes depend on what is asked before.
pub fn recognised(mut source: Source, identity: &Identity) -> Result<Source> {
    if !source.real_time {
        return Ok(source);
    }
    let mut room = [0; frame_bound(8)];
    // Behind an end of the line, for what the board may have received in part.
    let mut asks = vec![0];
    asks.extend_from_slice(encode(&Request::Start, &mut room)?);
    let (mut client, mut heard, mut buffer) = (Client::new(), Vec::new(), vec![0; PIECE]);
    let mut stranger = Stranger::default();
    let begun = Instant::now();
    while begun.elapsed() < PATIENCE {
        let sent = source.port.write(&asks)?;
        asks.drain(..sent);
        let Some(count) = source.port.read(&mut buffer)? else { break };
        heard.extend_from_slice(&buffer[..count]);
        stranger.take(&buffer[..count]);
        for byte in &buffer[..count] {
            match client.push(*byte) {
                Some(Event::Hello) => {}
                Some(Event::Unusable(why)) => fail!(SourceError::Foreign, "{}: {why}", source.label),
                _ => continue,
            }
            let Some(description) = client.description() else { continue };
            if let Some(how) = identity.differs(source.usb_serial.as_deref(), description) {
                fail!(SourceError::Other, "{} answers with another board: {how}", source.label);
            }
            return Ok(Source { port: Box::new(Heard::new(source.port, heard)), ..source });
        }
    }
    if client.counts().messages == 0 && !stranger.is_silent() {
        return Err(SourceError::Foreign(stranger.describe(&source.label)).into());
    }
    let seconds = PATIENCE.as_secs();
    fail!(SourceError::Silent, "{}: no Hello of a taxel board in {seconds} s", source.label)
}
