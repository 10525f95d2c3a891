//! A port whose bytes the page carries between Web Serial and the client.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use taxel::source::Port;

/// Most bytes that wait for the page to send them.
const ROOM: usize = 64 << 10;

/// Bytes on their way.
#[derive(Debug, Default)]
struct Queues {
    received: VecDeque<u8>,
    to_send: VecDeque<u8>,
    /// Reason why the port is gone.
    gone: Option<String>,
}

/// The port, and the page's end of it: both are the same value.
#[derive(Debug, Default, Clone)]
pub struct SerialPipe(Arc<Mutex<Queues>>);

impl SerialPipe {
    fn lock(&self) -> MutexGuard<'_, Queues> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes bytes that the page has read.
    pub fn receive(&self, bytes: &[u8]) {
        self.lock().received.extend(bytes);
    }

    /// Returns the bytes that the page is to write.
    pub fn take(&self) -> Vec<u8> {
        self.lock().to_send.drain(..).collect()
    }

    /// The page has opened the port again.
    pub fn find(&self) {
        *self.lock() = Queues::default();
    }

    /// Error while the port is gone.
    pub fn check(&self) -> taxel::Result<()> {
        self.lock().gone.clone().map_or(Ok(()), |why| Err(taxel::Error::other(why)))
    }

    /// The page cannot read or write any more, for this reason.
    pub fn lose(&self, why: &str) {
        self.lock().gone = Some(why.into());
    }
}

impl Port for SerialPipe {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let mut queues = self.lock();
        let count = queues.received.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(queues.received.drain(..count)) {
            *slot = byte;
        }
        match &queues.gone {
            Some(why) if count == 0 => Err(io::Error::other(why.clone())),
            _ => Ok(Some(count)),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut queues = self.lock();
        if let Some(why) = &queues.gone {
            return Err(io::Error::other(why.clone()));
        }
        let count = bytes.len().min(ROOM.saturating_sub(queues.to_send.len()));
        queues.to_send.extend(bytes.get(..count).unwrap_or(&[]));
        Ok(count)
    }
}
