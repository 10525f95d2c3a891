//! Two byte queues between the host and a board in another thread. The board blocks on a slow reader, so that
//! a simulation thins out nothing because of it. Where there are no threads it is the host's reading that moves the board.

use super::beside::yielded;
use super::shared::Shared;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;
use taxel_core::run::Link;

/// Most bytes queued for each end.
const ROOM: usize = 64 * 1024;
/// Longest wait of a read by the host.
const PATIENCE: Duration = Duration::from_millis(10);
/// True if the board has a thread of its own, and its host may wait for it.
const THREADS: bool = cfg!(not(target_family = "wasm"));

#[derive(Debug, Default)]
struct Queues {
    to_host: VecDeque<u8>,
    to_board: VecDeque<u8>,
    /// Bytes for the host so far: queued, and read.
    queued: u64,
    read: u64,
    /// Requests that did not come from the host, each with the number of bytes queued before it.
    own_requests: VecDeque<(u64, Vec<u8>)>,
    /// The host has read for the first time.
    begun: bool,
    host_gone: bool,
    board_gone: bool,
}

/// Creates both ends.
pub fn pipe() -> (HostEnd, BoardEnd) {
    let shared = Arc::new(Shared::default());
    (HostEnd(shared.clone()), BoardEnd(shared))
}

/// The host's end.
#[derive(Debug)]
pub struct HostEnd(Arc<Shared<Queues>>);

impl super::Port for HostEnd {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<Option<usize>> {
        self.0.change(|queues| queues.begun = true);
        #[cfg(target_family = "wasm")]
        super::beside::step();
        let mut queues = self.0.lock();
        if THREADS && queues.to_host.is_empty() && !queues.board_gone {
            queues = self.0.wait(queues, PATIENCE);
        }
        let count = queues.to_host.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(queues.to_host.drain(..count)) {
            *slot = byte;
        }
        queues.read += count as u64;
        self.0.wake();
        Ok((count > 0 || !queues.board_gone).then_some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let mut queues = self.0.lock();
        let count = bytes.len().min(ROOM.saturating_sub(queues.to_board.len()));
        queues.to_board.extend(&bytes[..count]);
        Ok(count)
    }

    fn own_requests(&mut self) -> Vec<u8> {
        let mut queues = self.0.lock();
        let read = queues.read;
        let mut all = Vec::new();
        while let Some((_, request)) = queues.own_requests.pop_front_if(|(after, _)| *after < read) {
            all.extend(request);
        }
        all
    }
}

impl Drop for HostEnd {
    fn drop(&mut self) {
        self.0.change(|queues| queues.host_gone = true);
    }
}

/// The board's end.
#[derive(Debug)]
pub struct BoardEnd(Arc<Shared<Queues>>);

impl BoardEnd {
    /// Waits for the host's first read. Returns false if there will be none.
    pub async fn begin(&self) -> bool {
        while self.is_refused(|queues| !queues.begun) {
            yielded().await;
        }
        !self.is_alone()
    }

    /// Waits until the host has read enough for what the next scan brings.
    pub async fn room(&self) {
        while self.is_refused(|queues| queues.to_host.len() >= ROOM) {
            yielded().await;
        }
    }

    /// True if the host's end is open and this holds, after waiting for a change of it.
    fn is_refused(&self, holds: impl Fn(&Queues) -> bool) -> bool {
        let mut queues = self.0.lock();
        if THREADS && holds(&queues) && !queues.host_gone {
            queues = self.0.wait(queues, Duration::from_secs(1));
        }
        holds(&queues) && !queues.host_gone
    }

    /// True if the host's end is closed.
    pub fn is_alone(&self) -> bool {
        self.0.lock().host_gone
    }

    /// Notes a request to the board that does not come from the host, which learns of it with what the board
    /// says next.
    pub(crate) fn note_request(&self, request: &[u8]) {
        let mut queues = self.0.lock();
        if !queues.host_gone {
            let after = queues.queued;
            queues.own_requests.push_back((after, request.into()));
        }
    }

    /// Reads up to the end of a request. Returns the number of bytes.
    pub(crate) fn read_request(&self, buffer: &mut [u8]) -> usize {
        let mut queues = self.0.lock();
        let mut count = 0;
        while let Some(slot) = buffer.get_mut(count)
            && let Some(byte) = queues.to_board.pop_front()
        {
            *slot = byte;
            count += 1;
            if byte == 0 {
                break;
            }
        }
        count
    }

    /// Sleeps, or returns early if the host's end is closed.
    pub fn sleep(&self, time: Duration) {
        let queues = self.0.lock();
        if !queues.host_gone {
            drop(queues);
            crate::time::sleep(time);
        }
    }
}

impl Link for &BoardEnd {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        let mut queues = self.0.lock();
        let count = queues.to_board.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(queues.to_board.drain(..count)) {
            *slot = byte;
        }
        count
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        if bytes.is_empty() {
            return 0;
        }
        let mut queues = self.0.lock();
        while THREADS && queues.to_host.len() >= ROOM && !queues.host_gone {
            queues = self.0.wait(queues, Duration::from_secs(1));
        }
        if !queues.host_gone {
            queues.to_host.extend(bytes);
            queues.queued += bytes.len() as u64;
            self.0.wake();
        }
        bytes.len()
    }
}

impl Drop for BoardEnd {
    fn drop(&mut self) {
        self.0.change(|queues| queues.board_gone = true);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Port;
    use super::*;
    use taxel_core::run::block_on;

    #[test]
    fn the_board_waits_for_the_reader_and_both_notice_the_end() {
        let (mut host, board) = pipe();
        host.write(b"go").unwrap();
        let thread = std::thread::spawn(move || {
            assert!(block_on(board.begin()));
            let mut buffer = [0; 8];
            let mut board = &board;
            assert_eq!(board.try_read(&mut buffer), 2);
            for part in 0..100u8 {
                assert_eq!(board.try_write(&[part; 10_000]), 10_000);
            }
        });
        let (mut count, mut buffer) = (0, [0; 1000]);
        while let Some(read) = host.read(&mut buffer).unwrap() {
            assert!(buffer[..read].iter().enumerate().all(|(i, b)| usize::from(*b) == (count + i) / 10_000));
            count += read;
        }
        assert_eq!(count, 1_000_000);
        thread.join().unwrap();
        let (host, board) = pipe();
        drop(host);
        assert!(!block_on(board.begin()) && board.is_alone());
        assert_eq!((&board).try_write(&[0; 100_000]), 100_000);
    }
}
