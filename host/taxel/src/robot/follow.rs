//! The loop that follows one board: opens and recognises it, waits for it while it is lost, and hands its stream to
//! observers.

use super::event::BoardState;
use super::recognise::recognised;
use super::refused::Required;
use crate::client::clock::SteadyTime;
use crate::client::{Buses, Client, Event, Identity, Stamp, Stamps, request_name};
use crate::error::{Error, ErrorKind, RecordingError, Result, SourceError};
use crate::session::{Observer, PATIENCE, Returns, RunLimit, Session, Turn};
use crate::source::Source;
use crate::text::words;
use crate::time::Instant;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
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
        crate::time::sleep(time);
    }
}

/// A board being followed: turn by turn, for who has other things to do in the same thread.
pub struct Following {
    session: Session,
    state: FollowState,
}

/// State of a board being followed.
struct FollowState {
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

/// A board being followed, and who is told.
struct Follower<'a> {
    observer: &'a mut (dyn Observer + 'a),
    supervisor: &'a mut (dyn Supervisor + 'a),
    state: &'a mut FollowState,
}

/// Supervisor of a board that is followed for as long as somebody calls for its next turn.
struct Onward;

impl Supervisor for Onward {
    fn goes_on(&mut self) -> bool {
        true
    }
}

impl Following {
    /// Opens a board that is there, alone.
    pub fn open(plan: BoardPlan, observer: &mut dyn Observer) -> Result<Following> {
        let time = (SteadyTime::start(), Buses::default());
        let opened = Following::begin(plan, observer, &mut Onward, time)?;
        opened.ok_or_else(|| Error::other("it is no longer wanted"))
    }

    /// Hands over what has come since the last turn, after a short while if it is nothing. Returns false at the end.
    pub fn turn(&mut self, observer: &mut dyn Observer) -> Result<bool> {
        self.turn_for(observer, &mut Onward)
    }

    /// Bytes that the last turn has handed over.
    pub fn bytes(&self) -> usize {
        self.session.bytes().len()
    }

    /// Ends it, for the observer, too. Returns what is to be remarked.
    pub fn end(mut self, observer: &mut dyn Observer) -> Result<Option<String>> {
        let stamp = self.state.stamps.now(self.session.client());
        observer.ended(self.session.client(), stamp)?;
        let source = self.session.source();
        Ok(source.port.remark().map(|remark| format!("{}: {remark}", source.label)))
    }

    fn turn_for(&mut self, observer: &mut dyn Observer, supervisor: &mut dyn Supervisor) -> Result<bool> {
        Follower { observer, supervisor, state: &mut self.state }.turn(&mut self.session)
    }

    /// Takes turn after turn.
    fn run(
        &mut self,
        observer: &mut dyn Observer,
        supervisor: &mut dyn Supervisor,
        asks: &Receiver<Ask>,
    ) -> Result<()> {
        while supervisor.goes_on() {
            asks.try_iter().try_for_each(|ask| ask(&mut self.session))?;
            if !self.turn_for(observer, supervisor)? {
                return Ok(());
            }
        }
        self.state.check_wanted(&self.session)
    }

    /// Opens a board; none if it is no longer to be followed before it is there.
    fn begin(
        plan: BoardPlan,
        observer: &mut dyn Observer,
        supervisor: &mut dyn Supervisor,
        (time, buses): (SteadyTime, Buses),
    ) -> Result<Option<Following>> {
        let BoardPlan { open, waits, identity, is_among, returns, begin, gather, limit, .. } = plan;
        let mut state = FollowState {
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
        let mut follower = Follower { observer, supervisor, state: &mut state };
        let Some(source) = follower.open(open, waits, identity.as_ref())? else { return Ok(None) };
        follower.supervisor.opened(&source);
        follower.observer.opened(&source)?;
        let mut session = Session::by(time, source, returns);
        session.gather(gather);
        identity.into_iter().for_each(|identity| session.recognise(identity));
        session.parts().0.share(buses);
        state.required = begin(&mut session)?;
        Ok(Some(Following { session, state }))
    }
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
/// `at` is the time of all boards, and the buses that they may share. Returns what is to be remarked at the end.
pub(super) fn follow(
    plan: BoardPlan,
    observer: &mut dyn Observer,
    supervisor: &mut dyn Supervisor,
    asks: &Receiver<Ask>,
    at: (SteadyTime, Buses),
) -> Result<Option<String>> {
    let Some(mut board) = Following::begin(plan, observer, supervisor, at)? else { return Ok(None) };
    let done = board.run(observer, supervisor, asks);
    // Whatever ended it, what has come until now is whole.
    let ended = board.end(observer);
    done.and(ended)
}

impl Follower<'_> {
    /// Waits for the board; none if it is no longer to be followed.
    fn open(&mut self, mut open: Opener, waits: bool, identity: Option<&Identity>) -> Result<Option<Source>> {
        let (mut pause, mut reported, mut other) = (TRY[0], false, None);
        while self.supervisor.goes_on() && !self.observer.is_done() {
            let opened = open().and_then(|source| match identity.filter(|_| self.state.is_among) {
                Some(identity) => recognised(source, identity),
                None => Ok(source),
            });
            let error = match opened {
                Ok(source) => return Ok(Some(source)),
                Err(error)
                    if !waits || self.state.limit.is_any() && self.state.begun.elapsed() > PATIENCE =>
                {
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

    /// Sends and reads, and hands over what has come. Returns false at the end.
    fn turn(&mut self, session: &mut Session) -> Result<bool> {
        self.pose(session)?;
        let turn = session.turn(&mut |client, bytes| self.sent(client, bytes))?;
        for original in session.original() {
            let stamp = self.state.stamps.now(session.client());
            self.observer.original(session.client(), original, stamp)?;
        }
        while !self.state.is_done
            && let Some(event) = session.next_event()
        {
            self.event(session, &event)?;
        }
        self.state.is_done |= self.state.limit.look(session)?;
        while self.state.is_done
            && let Some(note) = session.note()
        {
            self.pass(session.client(), &note)?;
        }
        if turn == Turn::End || self.state.is_done {
            return self.state.check_met(session).map(|()| false);
        }
        if self.state.is_known || !self.state.is_among {
            self.observer.idle(session.parts().0)?;
        }
        if self.observer.is_done() {
            return self.state.check_wanted(session).map(|()| false);
        }
        self.look_at_silence(session)?;
        Ok(true)
    }

    /// Hands positions of joints to whoever sends the board its posture, and to the observers.
    fn pose(&mut self, session: &mut Session) -> Result<()> {
        let Some((client, posing)) = session.posing() else { return Ok(()) };
        self.observer.pose(client, posing)?;
        for taken in posing.taken() {
            let stamp = self.state.stamps.of_time(client, taken.time.0);
            self.observer.joints(client, &taken, stamp)?;
        }
        Ok(())
    }

    /// Notes that the board has said nothing yet; error if a run of limited length has waited for it long enough.
    fn look_at_silence(&mut self, session: &mut Session) -> Result<()> {
        if self.state.is_among || session.client().description().is_some() || session.is_gone() {
            return Ok(());
        }
        let passed = self.state.begun.elapsed();
        if passed > QUIET && !std::mem::replace(&mut self.state.is_noted, true) {
            let text = format!("no Hello yet from {}", session.source().label);
            session.say(Level::Info, text);
        }
        if self.state.limit.is_any() && passed > PATIENCE { self.state.check_met(session) } else { Ok(()) }
    }

    /// Handles an event; passes it on if it is the board's.
    fn event(&mut self, session: &mut Session, event: &Event) -> Result<()> {
        let restarts = session.client().counts().restarts;
        if std::mem::replace(&mut self.state.restarts, restarts) != restarts {
            self.state.is_known = false;
        }
        // That of another board does not come.
        if *event == Event::Hello {
            self.state.is_known = true;
            if !std::mem::replace(&mut self.state.is_met, true) {
                self.supervisor.state(BoardState::Met);
            }
        }
        say(session.client(), event);
        if self.state.is_among {
            match event {
                Event::Unusable(why) => {
                    self.state.is_known = false;
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
        if self.state.is_known || !self.state.is_among || session.client().is_own() {
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
        if !self.state.is_known && self.state.is_among {
            return Ok(());
        }
        self.state.is_done |= self.state.limit.take(event);
        Ok(self.state.required.answered(&session.source().label, event)?)
    }

    /// Hands an event to the observers.
    fn pass(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.state.stamps.of(client, event);
        self.observer.event(client, event, stamp)
    }

    /// Hands over what is sent to the board.
    fn sent(&mut self, client: &Client, bytes: &[u8]) -> Result<()> {
        if bytes.is_empty() {
            return Ok(());
        }
        let stamp: Stamp = self.state.stamps.now(client);
        self.observer.sent(client, bytes, stamp)
    }
}

impl FollowState {
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

    /// Error if the stream of a board that is wanted alone has ended without it.
    fn check_wanted(&self, session: &Session) -> Result<()> {
        // One of several that is no longer wanted need not have been met.
        if self.is_among { Ok(()) } else { self.check_met(session) }
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
