//! The events that wait to be taken: bounded for each board.

use super::event::{BoardEvent, RobotEvent};
use crate::record::Stamp;
use crate::source::shared::Shared;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Most events of a board that wait.
pub const WAITING: usize = 256;
/// Time between two looks at a queue that is full.
const LOOK: Duration = Duration::from_millis(100);

/// What happens to a board's images while its events wait to be taken and there is no room for more. All
/// other events wait for room: the link then holds the board back, which leaves out images itself and counts
/// them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WhenFull {
    /// They wait, too.
    Wait,
    /// The oldest image is dropped and counted, except those of simulations and recordings, which wait.
    DropImages,
}

/// Events of all boards, in the order of their arrival.
#[derive(Debug)]
pub struct EventQueue<T>(Shared<WaitingEvents<T>>);

#[derive(Debug)]
struct WaitingEvents<T> {
    events: VecDeque<Waiter<T>>,
    boards: Vec<BoardQueue>,
    /// Nobody takes events any longer.
    closed: bool,
}

#[derive(Debug)]
struct Waiter<T> {
    event: RobotEvent<T>,
    is_image: bool,
}

/// The queue's counters of a board.
#[derive(Debug, Default, Clone, Copy)]
struct BoardQueue {
    waiting: usize,
    dropped: u64,
    /// `dropped` when it was told last.
    told: u64,
    over: bool,
}

impl<T> Default for WaitingEvents<T> {
    fn default() -> WaitingEvents<T> {
        WaitingEvents { events: VecDeque::new(), boards: Vec::new(), closed: false }
    }
}

impl<T> EventQueue<T> {
    /// An empty queue for this number of boards.
    pub fn new(boards: usize) -> EventQueue<T> {
        let queue = EventQueue(Shared::default());
        queue.0.lock().boards = vec![BoardQueue::default(); boards];
        queue
    }

    /// Adds an event once there is room. `droppable`: an image that may be dropped instead of waiting.
    pub fn push(&self, event: RobotEvent<T>, droppable: bool) {
        let board = event.board;
        let mut waiting = self.0.lock();
        while waiting.boards[board].waiting >= WAITING && !waiting.closed {
            if waiting.drop_image(board) {
                continue;
            }
            if droppable {
                waiting.boards[board].dropped += 1;
                return;
            }
            waiting = self.0.wait(waiting, LOOK);
        }
        waiting.boards[board].waiting += 1;
        waiting.events.push_back(Waiter { event, is_image: droppable });
        self.0.wake();
    }

    /// Takes the next event; none if there is none within this time.
    pub fn take(&self, patience: Duration) -> Option<RobotEvent<T>> {
        let until = Instant::now() + patience;
        let mut waiting = self.0.lock();
        loop {
            if let Some(event) = waiting.take() {
                self.0.wake();
                return Some(event);
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() || waiting.are_over() {
                return None;
            }
            waiting = self.0.wait(waiting, left);
        }
    }

    /// True once every board is over and all events are taken.
    pub fn is_over(&self) -> bool {
        let waiting = self.0.lock();
        waiting.events.is_empty() && waiting.are_over()
    }

    /// Images of a board dropped so far.
    pub fn dropped(&self, board: usize) -> u64 {
        self.0.lock().boards.get(board).map_or(0, |board| board.dropped)
    }

    /// A board's thread has ended.
    pub fn end(&self, board: usize) {
        self.0.change(|waiting| waiting.boards[board].over = true);
    }

    /// Nobody takes events any longer: nothing waits for room.
    pub fn close(&self) {
        self.0.change(|waiting| waiting.closed = true);
    }

    /// True once nobody takes events any longer.
    pub fn is_closed(&self) -> bool {
        self.0.lock().closed
    }

    /// Waits until the queue is closed, or for this time.
    pub fn pause(&self, time: Duration) {
        let until = Instant::now() + time;
        let mut waiting = self.0.lock();
        while !waiting.closed && Instant::now() < until {
            waiting = self.0.wait(waiting, until.saturating_duration_since(Instant::now()));
        }
    }
}

impl<T> WaitingEvents<T> {
    fn are_over(&self) -> bool {
        self.boards.iter().all(|board| board.over)
    }

    /// Drops the oldest image of a board that waits. Returns false if there is none.
    fn drop_image(&mut self, board: usize) -> bool {
        let is_one = |waiter: &Waiter<T>| waiter.is_image && waiter.event.board == board;
        let Some(at) = self.events.iter().position(is_one) else { return false };
        self.events.remove(at);
        self.boards[board].waiting -= 1;
        self.boards[board].dropped += 1;
        true
    }

    fn take(&mut self) -> Option<RobotEvent<T>> {
        let Waiter { event, .. } = self.events.front()?;
        let (board, stamp) = (event.board, event.stamp);
        if let Some(told) = self.drops(board, stamp) {
            return Some(told);
        }
        self.boards[board].waiting -= 1;
        self.events.pop_front().map(|waiter| waiter.event)
    }

    /// The event about images of a board that were dropped since the last one.
    fn drops(&mut self, board: usize, stamp: Stamp) -> Option<RobotEvent<T>> {
        let counts = &mut self.boards[board];
        if counts.told == counts.dropped {
            return None;
        }
        counts.told = counts.dropped;
        Some(RobotEvent { board, stamp, what: BoardEvent::Dropped { images: counts.dropped } })
    }
}
