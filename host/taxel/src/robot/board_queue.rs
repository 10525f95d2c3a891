//! A board's end of the queue.

use super::event::{BoardEvent, BoardState, RobotEvent};
use super::follow::Supervisor;
use super::queue::{EventQueue, WhenFull};
use crate::client::clock::SteadyTime;
use crate::client::{Client, Event, Stamp};
use crate::error::Result;
use crate::session::Observer;
use crate::source::Source;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Queues what observers make of a board's stream, and how the board is, in the board's own thread. Clones are of the
/// same board. What is added is queued together, once all bytes that have come are handled.
pub struct BoardQueue<T> {
    board: usize,
    queue: Arc<EventQueue<T>>,
    time: SteadyTime,
    when_full: WhenFull,
    batch: Arc<Mutex<Batch<T>>>,
}

/// Events that are queued next.
struct Batch<T> {
    /// Each with whether it may be dropped.
    events: Vec<(RobotEvent<T>, bool)>,
    /// Images may be dropped: somebody wants the newest, and the board does not wait.
    drops: bool,
}

impl<T> Clone for BoardQueue<T> {
    fn clone(&self) -> BoardQueue<T> {
        let (queue, batch) = (self.queue.clone(), self.batch.clone());
        BoardQueue { board: self.board, queue, time: self.time, when_full: self.when_full, batch }
    }
}

impl<T> BoardQueue<T> {
    /// Makes the queue of a board.
    pub(super) fn new(
        board: usize,
        queue: Arc<EventQueue<T>>,
        time: SteadyTime,
        when_full: WhenFull,
    ) -> BoardQueue<T> {
        let batch = Arc::new(Mutex::new(Batch { events: Vec::new(), drops: false }));
        BoardQueue { board, queue, time, when_full, batch }
    }

    /// Adds news of an event, which may be dropped if the event is an image.
    pub fn add(&self, event: &Event, stamp: Stamp, news: T) {
        let is_image = matches!(event, Event::Frame { .. } | Event::Raw { .. });
        self.push(stamp, BoardEvent::News(news), is_image);
    }

    /// Adds news of the end of the stream.
    pub fn add_last(&self, stamp: Stamp, news: T) {
        self.push(stamp, BoardEvent::News(news), false);
    }

    /// An observer that adds what this makes of events.
    pub fn make(
        &self,
        make: impl FnMut(&Client, &Event, Stamp) -> Option<T> + Send + 'static,
    ) -> Box<dyn Observer + Send>
    where
        T: Send + 'static,
    {
        Box::new(Maker { queue: self.clone(), make })
    }

    /// Queues all that was added.
    pub(super) fn hand_over(&self) {
        self.queue.push(self.board, &mut self.lock().events);
    }

    fn push(&self, stamp: Stamp, what: BoardEvent<T>, is_image: bool) {
        let mut batch = self.lock();
        let drops = is_image && batch.drops;
        batch.events.push((RobotEvent { board: self.board, stamp, what }, drops));
    }

    fn lock(&self) -> MutexGuard<'_, Batch<T>> {
        self.batch.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> Supervisor for BoardQueue<T> {
    /// Images may be dropped from now on, unless they are those of a simulation or a recording.
    fn opened(&mut self, source: &Source) {
        self.lock().drops = source.real_time && self.when_full == WhenFull::DropImages;
    }

    fn state(&mut self, state: BoardState) {
        let stamp = Stamp { board_us: 0, host_us: self.time.now_us(), uncertainty_us: Some(0) };
        self.push(stamp, BoardEvent::State(state), false);
    }

    fn goes_on(&mut self) -> bool {
        self.hand_over();
        !self.queue.is_closed()
    }

    fn pause(&mut self, time: Duration) {
        self.queue.pause(time);
    }
}

/// Adds what a function makes of events.
struct Maker<T, F> {
    queue: BoardQueue<T>,
    make: F,
}

impl<T, F: FnMut(&Client, &Event, Stamp) -> Option<T>> Observer for Maker<T, F> {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        if let Some(news) = (self.make)(client, event, stamp) {
            self.queue.add(event, stamp, news);
        }
        Ok(())
    }

    fn follows_another(&self) -> bool {
        true
    }
}
