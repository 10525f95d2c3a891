//! Follows one board in a thread of its own: recognises it, waits for it while it is lost, and queues what is
//! made of its events.

use super::event::{BoardEvent, RobotEvent, Teller};
use super::identity::Identity;
use super::queue::{EventQueue, WhenFull};
use super::recognise::recognised;
use super::refused::Required;
use crate::client::clock::SteadyTime;
use crate::client::{Buses, Client, Event};
use crate::error::{Error, RecordingError, Result, SourceError};
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
    identity: Identity,
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
    /// Why the link was lost last.
    why: String,
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
        identity,
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
        why: String::new(),
    };
    let ended = match follower.open(open, waits) {
        Ok(Some(source)) => follower.run(source, begin, asks, buses),
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
    fn open(&mut self, mut open: Opener, waits: bool) -> Result<Option<Source>> {
        let (mut pause, mut told, begun) = (TRY[0], false, Instant::now());
        while !self.queue.is_closed() {
            let error = match open().and_then(|source| recognised(source, &self.identity)) {
                Ok(source) => return Ok(Some(source)),
                Err(error) if !waits || self.limit.is_some() && begun.elapsed() > PATIENCE => {
                    return Err(error);
                }
                Err(error) => error,
            };
            self.tell_other();
            if !std::mem::replace(&mut told, true) {
                self.tell(BoardEvent::Absent { why: words::sentence(&error) });
            }
            self.hand_over();
            self.queue.pause(pause);
            pause = (pause * 2).min(TRY[1]);
        }
        Ok(None)
    }

    fn run(&mut self, source: Source, begin: Begin, asks: &Receiver<Ask>, buses: Buses) -> Result<()> {
        self.teller.opened(&source);
        self.drops = source.real_time && self.when_full == WhenFull::DropImages;
        let returns = self.limit.as_ref().map_or(Returns::Always, |_| Returns::Within(PATIENCE));
        let mut session = Session::by(self.time, source, returns);
        session.gather(self.gather);
        session.parts().0.share(buses);
        begin(&mut session)?;
        let (client, source) = session.parts();
        self.required = if source.listens { Required::of(client) } else { Required::default() };
        let mut gap: Option<Instant> = None;
        while !self.queue.is_closed() {
            asks.try_iter().try_for_each(|ask| ask(&mut session))?;
            let turn = session.turn::<Error>(&mut |client, bytes| self.asked(client, bytes))?;
            while !self.is_done
                && let Some(event) = session.next_event()
            {
                self.event(&mut session, &event)?;
            }
            self.is_done |= self.limit.as_mut().is_some_and(|limit| limit.look(&mut session));
            while let Some(note) = session.note() {
                if let Event::Log { text, .. } = &note {
                    self.why.clone_from(text);
                }
                let (client, stamp) = (session.client(), self.stamps.now(session.client()));
                let news = self.teller.note(client, &note, stamp)?;
                self.pass(stamp, news, false);
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
            self.tell_other();
            match (gap, session.gap()) {
                (None, Some(_)) => {
                    let since =
                        self.time.now_us().saturating_sub(session.heard().elapsed().as_micros() as u64);
                    self.tell(BoardEvent::Lost { since_us: since, why: self.why.clone() });
                }
                (Some(began), None) => self.tell(BoardEvent::Back { after: began.elapsed() }),
                _ => {}
            }
            gap = session.gap();
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
        if *event == Event::Hello
            && let Some(worn) = session.client().worn()
        {
            let checked = self.identity.check(session.source(), worn);
            self.is_known = checked.is_ok();
            if let Err(why) = checked {
                self.tell_other();
                return session.reject(SourceError::NoBoard(why).into());
            }
            if !std::mem::replace(&mut self.is_met, true) {
                self.tell(BoardEvent::Met);
            }
        }
        if let Event::Unusable(why) = event {
            self.is_known = false;
            let why = format!("{}: {why}", session.source().label);
            return session.reject(SourceError::Foreign(why).into());
        }
        if !self.is_known {
            return Ok(());
        }
        self.news(session.client(), event)?;
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

    /// Adds that another board has answered, if it has.
    fn tell_other(&mut self) {
        if let Some(why) = self.identity.other() {
            self.tell(BoardEvent::Other { why });
        }
    }

    fn add(&mut self, stamp: Stamp, what: BoardEvent<T>, is_image: bool) {
        self.waiting.push((RobotEvent { board: self.board, stamp, what }, is_image && self.drops));
    }

    /// Queues all that was added.
    fn hand_over(&mut self) {
        self.queue.push(self.board, &mut self.waiting);
    }
}
