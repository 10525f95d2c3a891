//! Follows one board in a thread of its own: recognises it, waits for it while it is lost, and queues what is
//! made of its events.

use super::event::{BoardEvent, RobotEvent, Teller};
use super::queue::{EventQueue, WhenFull};
use super::recognise::recognised;
use super::refused::Required;
use crate::client::clock::SteadyTime;
use crate::client::{Buses, Client, Event, Identity};
use crate::error::{Error, ErrorKind, RecordingError, Result, SourceError};
use crate::record::{Stamp, Stamps};
use crate::session::{PATIENCE, Returns, Session, TimeLimit, Turn};
use crate::source::Source;
use crate::tell::words;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

/// Time between two attempts to open a source that has not been there yet: first and longest.
const TRY: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(1)];

/// What is asked of a board while it is followed.
pub type Ask = Box<dyn FnOnce(&mut Session) -> Result<()> + Send>;
/// Opens a board's source for the first time.
pub type Opener = Box<dyn FnMut() -> Result<Source> + Send>;
/// Queues the requests with which a board begins, and names its body and its robot.
pub type Begin = Box<dyn FnOnce(&mut Session) -> Result<()> + Send>;

/// A board to be followed.
pub struct BoardPlan<T> {
    /// Its name.
    pub name: String,
    /// Opens its source.
    pub open: Opener,
    /// A source that cannot be opened is tried again: a board that may be plugged in later, not a file.
    pub waits: bool,
    /// It takes requests: it is not a recording.
    pub listens: bool,
    /// What it is recognised by.
    pub identity: Identity,
    /// Its first requests.
    pub begin: Begin,
    /// What is made of its events.
    pub teller: Box<dyn Teller<T>>,
    /// Time in which its bytes [gather](Session::gather).
    pub gather: Duration,
    /// Ends after this much of the board's time, and waits for a missing board for [`PATIENCE`] at most;
    /// none: goes on until its source ends.
    pub limit: Option<Duration>,
}

/// A board being followed.
pub struct Follower<T> {
    board: usize,
    queue: Arc<EventQueue<T>>,
    /// Events that are queued together once all bytes are read, and whether they may be dropped.
    waiting: Vec<(RobotEvent<T>, bool)>,
    when_full: WhenFull,
    teller: Box<dyn Teller<T>>,
    time: SteadyTime,
    stamps: Stamps,
    /// Images may be dropped: somebody wants the newest, and the board does not wait.
    drops: bool,
    /// The board is recognised, and has not restarted since.
    is_known: bool,
    is_met: bool,
    restarts: u64,
    required: Required,
    gather: Duration,
    limit: Option<TimeLimit>,
    /// The limit is reached.
    is_done: bool,
}

/// Follows a board until it is over or nobody takes its events any longer. `time` is that of all boards,
/// `buses` are those that they may share.
pub fn follow<T>(
    board: usize,
    plan: BoardPlan<T>,
    queue: Arc<EventQueue<T>>,
    when_full: WhenFull,
    asks: &Receiver<Ask>,
    (time, buses): (SteadyTime, Buses),
) {
    let BoardPlan { open, waits, identity, begin, teller, gather, limit, .. } = plan;
    let mut follower = Follower {
        board,
        queue,
        waiting: Vec::new(),
        when_full,
        teller,
        time,
        stamps: Stamps::by(time),
        drops: false,
        is_known: false,
        is_met: false,
        restarts: 0,
        required: Required::default(),
        gather,
        limit: limit.map(TimeLimit::of),
        is_done: false,
    };
    let ended = match follower.open(open, waits, &identity) {
        Ok(Some(source)) => follower.run(source, identity, begin, asks, buses),
        Ok(None) => return,
        Err(error) => Err(error),
    };
    follower.tell(match ended {
        Ok(()) => BoardEvent::Over,
        Err(error) => BoardEvent::Failed(error),
    });
    follower.hand_over();
}

impl<T> Follower<T> {
    /// Waits for the board; none if nobody takes events any longer.
    fn open(&mut self, mut open: Opener, waits: bool, identity: &Identity) -> Result<Option<Source>> {
        let (mut pause, mut told, mut other, begun) = (TRY[0], false, None, Instant::now());
        while !self.queue.is_closed() {
            let error = match open().and_then(|source| recognised(source, identity)) {
                Ok(source) => return Ok(Some(source)),
                Err(error) if !waits || self.limit.is_some() && begun.elapsed() > PATIENCE => {
                    return Err(error);
                }
                Err(error) => error,
            };
            if let ErrorKind::Source(SourceError::Other(why)) = error.kind()
                && other.as_ref() != Some(why)
            {
                self.tell(BoardEvent::Other { why: other.insert(why.clone()).clone() });
            }
            if !std::mem::replace(&mut told, true) {
                self.tell(BoardEvent::Absent { why: words::sentence(&error) });
            }
            self.hand_over();
            self.queue.pause(pause);
            pause = (pause * 2).min(TRY[1]);
        }
        Ok(None)
    }

    fn run(
        &mut self,
        source: Source,
        identity: Identity,
        begin: Begin,
        asks: &Receiver<Ask>,
        buses: Buses,
    ) -> Result<()> {
        self.teller.opened(&source);
        self.drops = source.real_time && self.when_full == WhenFull::DropImages;
        let returns = self.limit.as_ref().map_or(Returns::Always, |_| Returns::Within(PATIENCE));
        let mut session = Session::by(self.time, source, returns);
        session.gather(self.gather);
        session.recognise(identity);
        session.parts().0.share(buses);
        begin(&mut session)?;
        let (client, source) = session.parts();
        self.required = if source.listens { Required::of(client) } else { Required::default() };
        while !self.queue.is_closed() {
            asks.try_iter().try_for_each(|ask| ask(&mut session))?;
            let turn = session.turn::<Error>(&mut |client, bytes| self.asked(client, bytes))?;
            while !self.is_done
                && let Some(event) = session.next_event()
            {
                self.event(&mut session, &event)?;
            }
            self.is_done |= self.limit.as_mut().is_some_and(|limit| limit.look(&mut session));
            while self.is_done
                && let Some(note) = session.note()
            {
                self.news(session.client(), &note)?;
            }
            if turn == Turn::End || self.is_done {
                self.check_met(&session)?;
                let (client, stamp) = (session.client(), self.stamps.now(session.client()));
                let news = self.teller.ended(client, stamp)?;
                self.pass(stamp, news, false);
                return Ok(());
            }
            if self.is_known {
                self.teller.idle(session.parts().0)?;
            }
            self.hand_over();
        }
        Ok(())
    }

    /// Error if the stream has ended without a board.
    fn check_met(&self, session: &Session) -> Result<()> {
        let (label, bytes) = (&session.source().label, session.client().counts().bytes);
        let why = || format!("{label}: no Hello of a taxel board in {bytes} bytes");
        match session.source().listens {
            _ if self.is_met => Ok(()),
            true => Err(SourceError::Silent(why()).into()),
            false => Err(RecordingError::Record(why()).into()),
        }
    }

    /// Handles an event; passes it on if it is the board's.
    fn event(&mut self, session: &mut Session, event: &Event) -> Result<()> {
        let restarts = session.client().counts().restarts;
        if std::mem::replace(&mut self.restarts, restarts) != restarts {
            self.is_known = false;
        }
        // That of another board does not come.
        if *event == Event::Hello {
            self.is_known = true;
            if !std::mem::replace(&mut self.is_met, true) {
                self.tell(BoardEvent::Met);
            }
        }
        if let Event::Unusable(why) = event {
            self.is_known = false;
            let why = format!("{}: {why}", session.source().label);
            return session.reject(SourceError::Foreign(why).into());
        }
        if let Event::Other { why } = event {
            // It is refused: nothing is shown or recorded of it.
            self.tell(BoardEvent::Other { why: why.clone() });
            return Ok(());
        }
        if self.is_known || session.client().is_own() {
            self.news(session.client(), event)?;
        }
        match event {
            Event::Lost { why, since_us } => {
                self.tell(BoardEvent::Lost { since_us: *since_us, why: why.clone() })
            }
            Event::Back { after, .. } => self.tell(BoardEvent::Back { after: *after }),
            _ => {}
        }
        if !self.is_known {
            return Ok(());
        }
        self.is_done = self.limit.as_mut().is_some_and(|limit| limit.take(event));
        Ok(self.required.answered(&session.source().label, event)?)
    }

    /// Adds what is made of an event.
    fn news(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.stamps.of(client, event);
        let news = self.teller.event(client, event, stamp)?;
        self.pass(stamp, news, matches!(event, Event::Frame { .. } | Event::Raw { .. }));
        Ok(())
    }

    /// Adds what is made of requests to the board.
    fn asked(&mut self, client: &Client, bytes: &[u8]) -> Result<()> {
        if bytes.is_empty() {
            return Ok(());
        }
        let stamp = self.stamps.now(client);
        let news = self.teller.asked(client, bytes, stamp)?;
        self.pass(stamp, news, false);
        Ok(())
    }

    fn pass(&mut self, stamp: Stamp, news: Option<T>, is_image: bool) {
        news.into_iter().for_each(|news| self.add(stamp, BoardEvent::News(news), is_image));
    }

    /// Adds how the board is, now.
    fn tell(&mut self, what: BoardEvent<T>) {
        let stamp = Stamp { board_us: 0, host_us: self.time.now_us(), uncertainty_us: Some(0) };
        self.add(stamp, what, false);
    }

    fn add(&mut self, stamp: Stamp, what: BoardEvent<T>, is_image: bool) {
        self.waiting.push((RobotEvent { board: self.board, stamp, what }, is_image && self.drops));
    }

    /// Queues all that was added.
    fn hand_over(&mut self) {
        self.queue.push(self.board, &mut self.waiting);
    }
}
