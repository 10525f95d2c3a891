//! Recognises a board before anything is asked of it: its bytes go nowhere until its `Hello` is the right
//! one.

use super::identity::Identity;
use crate::client::{Client, Event};
use crate::error::{Result, SourceError};
use crate::source::{Port, Return, Source};
use std::io;
use std::time::{Duration, Instant};
use taxel_core::wire::{Request, encode, frame_bound};

/// Longest wait for a `Hello`: a board that does not stream sends one each second.
const PATIENCE: Duration = Duration::from_secs(3);
/// Bytes read at a time.
const PIECE: usize = 4096;

/// An open source once its board is recognised, and from then on each time that it is opened again.
/// Simulations and recordings, which do not run in real time, are recognised by who follows them: their first
/// bytes depend on what is asked before.
pub fn recognised(source: Source, identity: &Identity) -> Result<Source> {
    if !source.real_time {
        return Ok(source);
    }
    let mut source = greeted(source, identity)?;
    let identity = identity.clone();
    source.returns = source
        .returns
        .take()
        .map(|mut open| -> Box<Return> { Box::new(move || greeted(open()?, &identity)) });
    Ok(source)
}

/// Asks for a `Hello`, and compares it. The bytes read meanwhile are read again.
fn greeted(mut source: Source, identity: &Identity) -> Result<Source> {
    let mut room = [0; frame_bound(8)];
    // Behind an end of the line, for what the board may have received in part.
    let mut asks = vec![0];
    asks.extend_from_slice(encode(&Request::Start, &mut room)?);
    let (mut client, mut heard, mut buffer) = (Client::new(), Vec::new(), vec![0; PIECE]);
    let begun = Instant::now();
    while begun.elapsed() < PATIENCE {
        let sent = source.port.write(&asks)?;
        asks.drain(..sent);
        let Some(count) = source.port.read(&mut buffer)? else { break };
        heard.extend_from_slice(&buffer[..count]);
        for byte in &buffer[..count] {
            match client.push(*byte) {
                Some(Event::Hello) => {}
                Some(Event::Unusable(why)) => fail!(SourceError::NoBoard, "{}: {why}", source.label),
                _ => continue,
            }
            let Some(worn) = client.worn() else { continue };
            identity.check(&source, worn).map_err(SourceError::NoBoard)?;
            return Ok(Source { port: Box::new(Heard { heard, next: 0, port: source.port }), ..source });
        }
    }
    let seconds = PATIENCE.as_secs();
    fail!(SourceError::Silent, "{}: no Hello of a taxel board in {seconds} s", source.label)
}

/// A port from which bytes were read already.
struct Heard {
    heard: Vec<u8>,
    next: usize,
    port: Box<dyn Port>,
}

impl Port for Heard {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let left = &self.heard[self.next..];
        if left.is_empty() {
            return self.port.read(buffer);
        }
        let count = left.len().min(buffer.len());
        buffer[..count].copy_from_slice(&left[..count]);
        self.next += count;
        if self.next == self.heard.len() {
            (self.heard, self.next) = (Vec::new(), 0);
        }
        Ok(Some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.port.write(bytes)
    }

    fn told(&mut self) -> Vec<u8> {
        self.port.told()
    }

    fn keeps(&self) -> Duration {
        self.port.keeps()
    }

    fn news(&mut self) -> Option<String> {
        self.port.news()
    }

    fn remark(&self) -> Option<String> {
        self.port.remark()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A link with something to say.
    struct Link;

    impl Port for Link {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
            buffer[0] = 3;
            Ok(Some(1))
        }

        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            Ok(bytes.len())
        }

        fn told(&mut self) -> Vec<u8> {
            vec![4]
        }

        fn keeps(&self) -> Duration {
            PATIENCE
        }

        fn news(&mut self) -> Option<String> {
            Some("two publish it".into())
        }

        fn remark(&self) -> Option<String> {
            Some("the end".into())
        }
    }

    #[test]
    fn a_link_is_the_same_behind_what_was_heard_of_it() {
        let mut heard = Heard { heard: vec![1, 2], next: 0, port: Box::new(Link) };
        let mut buffer = [0];
        let read = std::iter::repeat_with(|| heard.read(&mut buffer).unwrap().map(|_| buffer[0]));
        assert_eq!(read.take(4).collect::<Vec<_>>(), [1, 2, 3, 3].map(Some));
        assert_eq!((heard.write(&[5, 6]).unwrap(), heard.told(), heard.keeps()), (2, vec![4], PATIENCE));
        assert_eq!(
            (heard.news().as_deref(), heard.remark().as_deref()),
            (Some("two publish it"), Some("the end"))
        );
    }
}
