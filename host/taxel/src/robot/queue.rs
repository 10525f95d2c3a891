//! The events that wait to be taken: bounded for each board.

use super::event::{BoardEvent, BoardState, RobotEvent};
use crate::client::Stamp;
use crate::time::Instant;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Most events of a board that wait.
pub const WAITING: usize = 256;
/// Most events that are taken at a time.
const BATCH: usize = 64;

/// Treatment of a board's images while its events wait to be taken and there is no room for more. All other events
/// wait for room: the link then holds the board back, which leaves out images itself and counts them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WhenFull {
    /// They wait, too.
    Wait,
    /// The oldest image is dropped and counted, except those of simulations and recordings, which wait.
    DropImages,
}

/// Events of all boards, in the order of their arrival. They come and go several at a time, because to wake a
/// thread and to lock cost more than an event. Each board waits for its own room: of many, an event that is
/// taken wakes one.
#[derive(Debug)]
pub struct EventQueue<T> {
    waiting: Mutex<WaitingEvents<T>>,
    /// An event has come, or a board is over.
    came: Condvar,
    /// There is room for events of a board, by its number.
    room: Vec<Condvar>,
    /// Nobody takes events any longer.
    closed: Condvar,
}

#[derive(Debug)]
struct WaitingEvents<T> {
    events: VecDeque<Waiter<T>>,
    boards: Vec<QueuedBoard>,
    /// True if whoever takes events waits for one.
    is_awaited: bool,
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
struct QueuedBoard {
    waiting: usize,
    /// Images among them that may be dropped.
    images: usize,
    dropped: u64,
    /// `dropped` when it was reported last.
    reported: u64,
    over: bool,
}

impl<T> Default for WaitingEvents<T> {
    fn default() -> WaitingEvents<T> {
        WaitingEvents { events: VecDeque::new(), boards: Vec::new(), is_awaited: false, closed: false }
    }
}

impl<T> EventQueue<T> {
    /// An empty queue for this number of boards.
    pub fn new(boards: usize) -> EventQueue<T> {
        let waiting =
            WaitingEvents { boards: vec![QueuedBoard::default(); boards], ..WaitingEvents::default() };
        let room = (0..boards).map(|_| Condvar::new()).collect();
        EventQueue { waiting: Mutex::new(waiting), came: Condvar::new(), room, closed: Condvar::new() }
    }

    /// Locks what waits. A panic of another thread does not poison it.
    fn lock(&self) -> MutexGuard<'_, WaitingEvents<T>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds events of a board, each once there is room, and leaves none. True: an image that may be dropped
    /// instead of waiting.
    pub fn push(&self, board: usize, events: &mut Vec<(RobotEvent<T>, bool)>) {
        if events.is_empty() {
            return;
        }
        let mut waiting = self.lock();
        for (event, is_image) in events.drain(..) {
            while !is_image && !waiting.make_room(board) {
                self.wake(&mut waiting);
                waiting = self.room[board].wait(waiting).unwrap_or_else(PoisonError::into_inner);
            }
            waiting.add(board, Waiter { event, is_image });
        }
        self.wake(&mut waiting);
    }

    /// Wakes whoever waits for events.
    fn wake(&self, waiting: &mut WaitingEvents<T>) {
        if std::mem::take(&mut waiting.is_awaited) {
            self.came.notify_all();
        }
    }

    /// Takes the next events; none if there are none within this time.
    pub fn take(&self, patience: Duration, taken: &mut VecDeque<RobotEvent<T>>) {
        let until = Instant::now() + patience;
        let mut waiting = self.lock();
        while waiting.events.is_empty() {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() || waiting.are_over() {
                return;
            }
            waiting.is_awaited = true;
            waiting = self.came.wait_timeout(waiting, left).unwrap_or_else(PoisonError::into_inner).0;
        }
        while taken.len() < BATCH
            && let Some(event) = waiting.take()
        {
            // Not for each event: a board then does more at a time.
            if waiting.boards[event.board].waiting == WAITING / 2 {
                self.room[event.board].notify_all();
            }
            taken.push_back(event);
        }
    }

    /// True once every board is over and all events are taken.
    pub fn is_over(&self) -> bool {
        let waiting = self.lock();
        waiting.events.is_empty() && waiting.are_over()
    }

    /// Images of a board dropped so far.
    pub fn dropped(&self, board: usize) -> u64 {
        self.lock().boards.get(board).map_or(0, |board| board.dropped)
    }

    /// A board's thread has ended.
    pub fn end(&self, board: usize) {
        self.lock().boards[board].over = true;
        self.came.notify_all();
    }

    /// Nobody takes events any longer: nothing waits for room.
    pub fn close(&self) {
        self.lock().closed = true;
        self.closed.notify_all();
        self.room.iter().for_each(Condvar::notify_all);
    }

    /// True once nobody takes events any longer.
    pub fn is_closed(&self) -> bool {
        self.lock().closed
    }

    /// Waits until the queue is closed, or for this time.
    pub fn pause(&self, time: Duration) {
        let until = Instant::now() + time;
        let mut waiting = self.lock();
        while !waiting.closed && Instant::now() < until {
            let left = until.saturating_duration_since(Instant::now());
            waiting = self.closed.wait_timeout(waiting, left).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl<T> WaitingEvents<T> {
    /// Adds an event of a board, unless it is an image without room.
    fn add(&mut self, board: usize, waiter: Waiter<T>) {
        if waiter.is_image && !self.make_room(board) {
            self.boards[board].dropped += 1;
            return;
        }
        self.boards[board].waiting += 1;
        self.boards[board].images += usize::from(waiter.is_image);
        self.events.push_back(waiter);
    }

    /// True if there is room for another event of a board: its oldest image is dropped if need be.
    fn make_room(&mut self, board: usize) -> bool {
        self.closed || self.boards[board].waiting < WAITING || self.drop_image(board)
    }

    fn are_over(&self) -> bool {
        self.boards.iter().all(|board| board.over)
    }

    /// Drops the oldest image of a board that waits. Returns false if there is none.
    fn drop_image(&mut self, board: usize) -> bool {
        // Most have none, and the queue of many boards is long.
        if self.boards[board].images == 0 {
            return false;
        }
        let is_one = |waiter: &Waiter<T>| waiter.is_image && waiter.event.board == board;
        let Some(at) = self.events.iter().position(is_one) else { return false };
        self.events.remove(at);
        self.boards[board].waiting -= 1;
        self.boards[board].images -= 1;
        self.boards[board].dropped += 1;
        true
    }

    fn take(&mut self) -> Option<RobotEvent<T>> {
        let Waiter { event, .. } = self.events.front()?;
        let (board, stamp) = (event.board, event.stamp);
        if let Some(reported) = self.drops(board, stamp) {
            return Some(reported);
        }
        let Waiter { event, is_image } = self.events.pop_front()?;
        self.boards[board].waiting -= 1;
        self.boards[board].images -= usize::from(is_image);
        Some(event)
    }

    /// The event about images of a board that were dropped since the last one.
    fn drops(&mut self, board: usize, stamp: Stamp) -> Option<RobotEvent<T>> {
        let counts = &mut self.boards[board];
        if counts.reported == counts.dropped {
            return None;
        }
        counts.reported = counts.dropped;
        Some(RobotEvent {
            board,
            stamp,
            what: BoardEvent::State(BoardState::Dropped { images: counts.dropped }),
        })
    }
}
