//! The loop that follows one board: opens and recognises it, waits for it while it is lost, and hands its stream to
//! observers.

use super::event::BoardState;
use super::recognise::recognised;
use super::refused::Required;
use crate::client::clock::SteadyTime;
use crate::client::{Buses, Client, Event, Identity, Stamp, Stamps, request_name};
use crate::error::{ErrorKind, RecordingError, Result, SourceError};
use crate::session::{Observer, PATIENCE, Returns, RunLimit, Session, Turn};
use crate::source::Source;
use crate::text::words;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use taxel_core::wire::Level;

/// Time between two attempts to open a source that has not been there yet: first and longest.
const TRY: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(1)];
/// Silence of a board that has said nothing yet, after which that is noted.
const QUIET: Duration = Duration::from_secs(3);

/// Request to a board while it is followed.
pub type Ask = Box<dyn FnOnce(&mut Session) -> Result<()> + Send>;
/// Opens a board's source for the first time.
pub type Opener = Box<dyn FnMut() -> Result<Source> + Send>;
/// Queues the requests with which a board begins, and names its body and its robot. Returns those that it must accept.
pub type Begin = Box<dyn FnOnce(&mut Session) -> Result<Required> + Send>;

/// A board to be followed.
pub struct BoardPlan {
    /// Name of the board.
    pub name: String,
    /// Opens its source.
    pub open: Opener,
    /// A source that cannot be opened is tried again: a board that may be plugged in later, not a file.
    pub waits: bool,
    /// True if it takes requests: it is not a recording.
    pub listens: bool,
    /// Identity by which it is recognised; none if any board will do.
    pub identity: Option<Identity>,
    /// True if it is one of several: nothing of it is passed on before it is recognised, and another board in its
    /// place is [reported](BoardState::Other), not followed.
    pub is_among: bool,
    /// Action when it is lost.
    pub returns: Returns,
    /// First requests.
    pub begin: Begin,
    /// Time in which its bytes [gather](Session::gather).
    pub gather: Duration,
    /// Limit at which it ends; a missing board is waited for [`PATIENCE`] at most if it ends at all.
    pub limit: RunLimit,
}

impl BoardPlan {
    /// One of several boards, of any identity: whoever is met first is known from then on. It is waited for, and
    /// goes on without end.
    pub fn of(
        name: impl Into<String>,
        open: impl FnMut() -> Result<Source> + Send + 'static,
        begin: impl FnOnce(&mut Session) -> Result<Required> + Send + 'static,
    ) -> BoardPlan {
        BoardPlan {
            name: name.into(),
            open: Box::new(open),
            waits: true,
            listens: true,
            identity: Some(Identity::default()),
            is_among: true,
            returns: Returns::Always,
            begin: Box::new(begin),
            gather: Duration::ZERO,
            limit: RunLimit::of(None, None),
        }
    }
}

/// Supervisor of a board that is followed.
pub trait Supervisor {
    /// Hears that the board's source is open.
    fn opened(&mut self, _source: &Source) {}

    /// Hears how the board is from now on.
    fn state(&mut self, _state: BoardState) {}

    /// Called once the bytes that have come are handled, or after a short while without any, and between two attempts
    /// to open the board. False: it is no longer followed.
    fn goes_on(&mut self) -> bool;

    /// Waits for so long before the next attempt to open the board, or until it is no longer to be followed.
    fn pause(&mut self, time: Duration) {
        std::thread::sleep(time);
    }
}

/// A board being followed.
struct Follower<'a> {
    observer: &'a mut (dyn Observer + 'a),
    supervisor: &'a mut (dyn Supervisor + 'a),
    stamps: Stamps,
    /// Nothing of it is passed on before it is recognised.
    is_among: bool,
    /// The board is recognised, and has not restarted since.
    is_known: bool,
    is_met: bool,
    restarts: u64,
    required: Required,
    limit: RunLimit,
    /// The limit is reached.
    is_done: bool,
    begun: Instant,
    /// True if its silence is noted.
    is_noted: bool,
}

/// Follows a board alone, in this thread. Returns what is to be remarked at the end.
pub fn follow_alone(
    plan: BoardPlan,
    observer: &mut dyn Observer,
    supervisor: &mut dyn Supervisor,
) -> Result<Option<String>> {
    let (_, asks) = channel();
    follow(plan, observer, supervisor, &asks, (SteadyTime::start(), Buses::default()))
}

/// Follows a board until it is over, its limit is reached, an observer is done, or it is no longer to be followed.
/// `time` is that of all boards, `buses` are those that they may share. Returns what is to be remarked at the end.
pub(super) fn follow(
    plan: BoardPlan,
    observer: &mut dyn Observer,
    supervisor: &mut dyn Supervisor,
    asks: &Receiver<Ask>,
    (time, buses): (SteadyTime, Buses),
) -> Result<Option<String>> {
    let BoardPlan { open, waits, identity, is_among, returns, begin, gather, limit, .. } = plan;
    let mut follower = Follower {
        observer,
        supervisor,
        stamps: Stamps::by(time),
        is_among,
        is_known: false,
        is_met: false,
        restarts: 0,
        required: Required::default(),
        limit,
        is_done: false,
        begun: Instant::now(),
        is_noted: false,
    };
    let Some(source) = follower.open(open, waits, identity.as_ref())? else { return Ok(None) };
    follower.supervisor.opened(&source);
    follower.observer.opened(&source)?;
    let mut session = Session::by(time, source, returns);
    session.gather(gather);
    identity.into_iter().for_each(|identity| session.recognise(identity));
    session.parts().0.share(buses);
    follower.required = begin(&mut session)?;
    let done = follower.run(&mut session, asks);
    // Whatever ended it, what has come until now is whole.
    let (client, stamp) = (session.client(), follower.stamps.now(session.client()));
    let ended = follower.observer.ended(client, stamp);
    done.and(ended)?;
    let source = session.source();
    Ok(source.port.remark().map(|remark| format!("{}: {remark}", source.label)))
}

impl Follower<'_> {
    /// Waits for the board; none if it is no longer to be followed.
    fn open(&mut self, mut open: Opener, waits: bool, identity: Option<&Identity>) -> Result<Option<Source>> {
        let (mut pause, mut reported, mut other) = (TRY[0], false, None);
        while self.supervisor.goes_on() && !self.observer.is_done() {
            let opened = open().and_then(|source| match identity.filter(|_| self.is_among) {
                Some(identity) => recognised(source, identity),
                None => Ok(source),
            });
            let error = match opened {
                Ok(source) => return Ok(Some(source)),
                Err(error) if !waits || self.limit.is_any() && self.begun.elapsed() > PATIENCE => {
                    return Err(error);
                }
                Err(error) => error,
            };
            if let ErrorKind::Source(SourceError::Other(why)) = error.kind()
                && other.as_ref() != Some(why)
            {
                self.supervisor.state(BoardState::Other { why: other.insert(why.clone()).clone() });
            }
            if !std::mem::replace(&mut reported, true) {
                self.supervisor.state(BoardState::Absent { why: words::sentence(&error) });
            }
            if self.supervisor.goes_on() {
                self.supervisor.pause(pause);
            }
            pause = (pause * 2).min(TRY[1]);
        }
        Ok(None)
    }

    fn run(&mut self, session: &mut Session, asks: &Receiver<Ask>) -> Result<()> {
        let is_limited = self.limit.is_any();
        while self.supervisor.goes_on() {
            asks.try_iter().try_for_each(|ask| ask(session))?;
            self.pose(session)?;
            let turn = session.turn(&mut |client, bytes| self.sent(client, bytes))?;
            for original in session.original() {
                let stamp = self.stamps.now(session.client());
                self.observer.original(session.client(), original, stamp)?;
            }
            while !self.is_done
                && let Some(event) = session.next_event()
            {
                self.event(session, &event)?;
            }
            self.is_done |= self.limit.look(session)?;
            while self.is_done
                && let Some(note) = session.note()
            {
                self.pass(session.client(), &note)?;
            }
            if turn == Turn::End || self.is_done {
                return self.check_met(session);
            }
            if self.is_known || !self.is_among {
                self.observer.idle(session.parts().0)?;
            }
            if self.observer.is_done() {
                break;
            }
            self.look_at_silence(session, is_limited)?;
        }
        // A board that is no longer wanted need not have been met, but whoever wanted it alone learns that it was not.
        if self.is_among { Ok(()) } else { self.check_met(session) }
    }

    /// Hands positions of joints to whoever sends the board its posture, and to the observers.
    fn pose(&mut self, session: &mut Session) -> Result<()> {
        let Some((client, posing)) = session.posing() else { return Ok(()) };
        self.observer.pose(client, posing)?;
        for taken in posing.taken() {
            let stamp = self.stamps.of_time(client, taken.time.0);
            self.observer.joints(client, &taken, stamp)?;
        }
        Ok(())
    }

    /// Notes that the board has said nothing yet; error if a run of limited length has waited for it long enough.
    fn look_at_silence(&mut self, session: &mut Session, is_limited: bool) -> Result<()> {
        if self.is_among || session.client().description().is_some() || session.is_gone() {
            return Ok(());
        }
        let passed = self.begun.elapsed();
        if passed > QUIET && !std::mem::replace(&mut self.is_noted, true) {
            let text = format!("no Hello yet from {}", session.source().label);
            session.say(Level::Info, text);
        }
        if is_limited && passed > PATIENCE { self.check_met(session) } else { Ok(()) }
    }

    /// Error if the stream has ended without a board.
    fn check_met(&self, session: &Session) -> Result<()> {
        let (label, bytes) = (&session.source().label, session.client().counts().bytes);
        let why = || format!("{label}: no Hello of a taxel board in {bytes} bytes");
        match session.source().listens {
            _ if self.is_met || session.client().description().is_some() => Ok(()),
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
                self.supervisor.state(BoardState::Met);
            }
        }
        say(session.client(), event);
        if self.is_among {
            match event {
                Event::Unusable(why) => {
                    self.is_known = false;
                    let why = format!("{}: {why}", session.source().label);
                    return session.reject(SourceError::Foreign(why).into());
                }
                Event::Other { why } => {
                    // It is refused: nothing is shown or recorded of it.
                    self.supervisor.state(BoardState::Other { why: why.clone() });
                    return Ok(());
                }
                _ => {}
            }
        }
        if self.is_known || !self.is_among || session.client().is_own() {
            self.pass(session.client(), event)?;
        }
        match event {
            Event::Lost { why, since_us } => {
                self.supervisor.state(BoardState::Lost { since_us: *since_us, why: why.clone() })
            }
            Event::Back { after, .. } => self.supervisor.state(BoardState::Back { after: *after }),
            Event::Other { why } if !self.observer.follows_another() => {
                return Err(SourceError::Other(why.clone()).into());
            }
            _ => {}
        }
        if !self.is_known && self.is_among {
            return Ok(());
        }
        self.is_done |= self.limit.take(event);
        Ok(self.required.answered(&session.source().label, event)?)
    }

    /// Hands an event to the observers.
    fn pass(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.stamps.of(client, event);
        self.observer.event(client, event, stamp)
    }

    /// Hands over what is sent to the board.
    fn sent(&mut self, client: &Client, bytes: &[u8]) -> Result<()> {
        if bytes.is_empty() {
            return Ok(());
        }
        let stamp: Stamp = self.stamps.now(client);
        self.observer.sent(client, bytes, stamp)
    }
}

/// Reports an event for `-v`.
fn say(client: &Client, event: &Event) {
    match event {
        Event::Hello => {
            if let Some(description) = client.description() {
                let (firmware, garment, scene) =
                    (&description.firmware, &description.garment.name, &description.scene.name);
                log::info!("board {firmware}: garment {garment}, scene {scene}");
            }
        }
        Event::Answer { request, refusal: None } => {
            log::info!("the board has done {}", request_name(*request));
        }
        Event::Answer { request, refusal: Some(why) } => {
            log::info!("the board refuses {}: {why}", request_name(*request));
        }
        _ => {}
    }
}
