//! A board's stream for other programs, and the loop by which every command follows a source.
//!
//! ```
//! use taxel::client::Event;
//! use taxel::session::Session;
//!
//! let session = Session::open("sim:pat")?;
//! let contacts = session.filter(|event| matches!(event, Ok(Event::Contacts { .. })));
//! assert!(contacts.take(3).count() == 3);
//! # Ok::<(), taxel::Error>(())
//! ```
//!
//! A board that restarts, is unplugged or loses its connection is waited for, and all its settings are
//! restored: garment, scene, gains and calibration, shapes, gestures, feeds, tare. [`Event::Lost`] begins a gap and
//! [`Event::Back`] ends it. What was present when the board was lost ends then, by events such as the board sends: nobody
//! knows whether it goes on. If the board has lived on and still feels a contact, this begins anew, with its id. It is an
//! error if the board refuses a setting that it had accepted before.
//!
//! Another board that answers in its place is an [`Event::Other`]: the stream goes on with that one, which gets no
//! setting of the one before, or it is refused ([`Session::recognise`]). See [`Identity`] for how boards are
//! distinguished.
//!
//! | file | holds |
//! |---|---|
//! | `gather.rs` | when bytes that gather are read |
//! | `outgoing.rs` | requests on their way to a board that may not read |
//! | `absence.rs` | a lost source, until it is back |
//! | `setting.rs` | garments, scenes and models of the user, queued as requests |
//! | `joint_time.rs` | when positions of joints were read |
//! | `moving.rs` | how the links move that carry a garment |
//! | `posing.rs` | [`Posing`]: a robot's posture, sent to the board |
//! | `joint_states.rs` | positions of joints as lines |
//! | `limit.rs` | [`RunLimit`]: the end of a run that is limited in images or time |
//! | `observer.rs` | [`Observer`]: who is handed the stream |

mod absence;
mod gather;
mod joint_states;
mod joint_time;
mod limit;
mod moving;
mod observer;
mod outgoing;
mod posing;
pub mod setting;

pub use joint_states::JointStates;
pub use joint_time::JointTime;
pub use limit::{PATIENCE, RunLimit};
pub use observer::Observer;
pub use posing::{JointPositions, POSES, POSES_HZ, Posing};

use crate::client::clock::SteadyTime;
use crate::client::{Client, Event, Identity, Restored, request_name};
use crate::error::{Error, Result, SourceError, UsageError};
use crate::source::array::OriginalBytes;
use crate::source::{self, Source, SourceOptions, SourceSpec, Stranger};
use crate::time::{Instant, sleep};
use absence::Absence;
use gather::Gather;
use outgoing::Outgoing;
use std::time::Duration;
use taxel_core::format::Micros;
use taxel_core::wire::{Level, Request};

/// A streaming board sends something every second: one silent for this long is lost, whatever its link
/// reports.
const SILENCE: Duration = Duration::from_secs(5);
/// Longest wait for an answer before all settings are restored.
const ANSWER: Duration = Duration::from_secs(3);
/// Time between two requests for a `Hello`.
const GREETING: Duration = Duration::from_secs(1);
/// Time after which what sends, and no message of a board, is something else.
const FOREIGN: Duration = Duration::from_millis(2500);
/// Bytes read at a time.
const PIECE: usize = 16 << 10;

/// A streaming board. Dropping it closes the connection.
pub struct Session {
    source: Source,
    client: Client,
    time: SteadyTime,
    buffer: Vec<u8>,
    /// Bytes of an array, of the last turn.
    original: Vec<OriginalBytes>,
    taken: usize,
    outgoing: Outgoing,
    /// Time at which bytes were last received, and at which a `Hello` was last requested.
    heard: Instant,
    greeted: Instant,
    /// Time at which the link was opened.
    opened: Instant,
    absence: Option<Absence>,
    /// Start of a gap in the stream, which ends once the board's settings are restored.
    gap: Option<Instant>,
    returns: Returns,
    posing: Option<Posing>,
    gather: Gather,
    /// Bytes that were received before the first message of a board.
    stranger: Stranger,
}

/// Action on a lost source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Returns {
    /// Wait for it.
    Always,
    /// Wait for it this long.
    Within(Duration),
    /// End the session.
    Never,
}

/// Receives the requests that go to the board, as bytes.
pub(crate) type OnSent<'a> = dyn FnMut(&Client, &[u8]) -> Result<()> + 'a;

/// Result of [`Session::turn`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// Bytes, or none within a short while.
    Bytes,
    /// The source is lost, and waited for.
    Waiting,
    /// The stream has ended.
    End,
}

impl Session {
    /// Connects to a source as named for `--source` (`auto`, `usb`, `sim:pat`, `serial:/dev/ttyACM0`,
    /// `tcp:HOST:PORT` ...) and requests the whole stream, after a tare if a simulation wants one.
    pub fn open(source: &str) -> Result<Session> {
        let spec: SourceSpec =
            source.parse().map_err(|why| UsageError::Unknown(format!("source {source}: {why}")))?;
        Session::over(source::open(&spec, &SourceOptions::default())?)
    }

    /// Requests the whole stream from an open source.
    pub fn over(source: Source) -> Result<Session> {
        let tare = source.tare;
        let mut session = Session::new(source, Returns::Always);
        session.client.start(tare)?;
        Ok(session)
    }

    /// A session with an open source that requests nothing yet.
    pub fn new(source: Source, returns: Returns) -> Session {
        Session::by(SteadyTime::start(), source, returns)
    }

    /// Makes a session by a time of the host that others go by, too: if the calendar is set between the starts of two
    /// times, these differ.
    pub fn by(time: SteadyTime, source: Source, returns: Returns) -> Session {
        let now = Instant::now();
        let mut client = Client::new();
        client.linked(&source.label, source.usb_serial.as_deref());
        client.expect(source.scene.clone());
        client.weigh_by(source.scale.clone());
        Session {
            source,
            client,
            time,
            buffer: Vec::new(),
            original: Vec::new(),
            taken: 0,
            outgoing: Outgoing::default(),
            heard: now,
            greeted: now,
            opened: now,
            absence: None,
            gap: None,
            returns,
            posing: None,
            gather: Gather::default(),
            stranger: Stranger::default(),
        }
    }

    /// Bytes that come within this time of the last ones are read together from now on, as far as the link
    /// [keeps](source::Port::keeps) them: for whoever handles much, and not at once. They are read as they come while
    /// a round trip is measured, and if a robot's posture is sent to the board.
    pub fn gather(&mut self, time: Duration) {
        self.gather.time = time;
    }

    /// Follows the board of this identity only. Another one is refused: [`Event::Other`] says so, its link is given up,
    /// and the right one is waited for; error if the source is not waited for.
    pub fn recognise(&mut self, identity: Identity) {
        self.client.recognise(identity);
    }

    /// Sends the board its robot's posture from now on.
    pub fn pose_by(&mut self, posing: Posing) {
        self.posing = Some(posing);
    }

    /// Returns what sends the board its robot's posture, and the client.
    pub fn posing(&mut self) -> Option<(&Client, &mut Posing)> {
        self.posing.as_mut().map(|posing| (&self.client, posing))
    }

    /// Takes positions of joints, rad or m, for the board's poses. Error if nobody sends it its posture
    /// ([`Session::pose_by`]), or as of [`Posing::take`].
    pub fn take_joints<'a>(
        &mut self,
        at: JointTime,
        positions: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<()> {
        let Some(posing) = &mut self.posing else {
            fail!(UsageError::Argument, "no robot was named whose joints these are");
        };
        posing.take(&self.client, at, positions)
    }

    /// Current state: image, contacts, intention, health.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// The client, for requests, and the source.
    pub fn parts(&mut self) -> (&mut Client, &Source) {
        (&mut self.client, &self.source)
    }

    /// The source.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// True while the source is lost and waited for.
    pub fn is_gone(&self) -> bool {
        self.absence.is_some()
    }

    /// Since when the stream has a gap: until the source is back and its board's settings are restored.
    pub fn gap(&self) -> Option<Instant> {
        self.gap
    }

    /// Gives up the link as if it were lost, for this reason: what answers is not the board that was meant.
    /// Error if the source is not waited for.
    pub fn reject(&mut self, why: Error) -> Result<()> {
        self.buffer.clear();
        self.taken = 0;
        self.lose(why).map(drop)
    }

    /// Queues a request to the board; the answer is an [`Event::Answer`].
    pub fn request(&mut self, request: &Request<'_>) -> Result<()> {
        Ok(self.client.request(request)?)
    }

    /// Returns an event, or nothing if none is complete within a short while (10 ms to a second, depending on
    /// the link).
    pub fn poll(&mut self) -> Result<Poll> {
        if let Some(event) = self.next_event() {
            return Ok(Poll::Event(event));
        }
        Ok(match self.turn(&mut |_, _| Ok(()))? {
            Turn::Bytes | Turn::Waiting => Poll::Nothing,
            Turn::End => Poll::End,
        })
    }

    /// Waits for the next event; none at the end of the stream. The [`client`](Session::client) already
    /// includes it.
    pub fn wait(&mut self) -> Result<Option<Event>> {
        loop {
            match self.poll()? {
                Poll::Event(event) => return Ok(Some(event)),
                Poll::Nothing => {}
                Poll::End => return Ok(None),
            }
        }
    }

    /// Sends queued requests after passing them to `sent`, and reads; requests of the source itself are
    /// passed to `sent`, too. Error if the source is lost for good, or if its board refuses a setting that it
    /// had accepted before; `sent` has errors of the caller's own.
    pub(crate) fn turn(&mut self, sent: &mut OnSent<'_>) -> Result<Turn> {
        self.buffer.clear();
        self.taken = 0;
        if self.absence.is_some() {
            return self.come_back();
        }
        if let Some(why) = self.client.refused() {
            return self.lose(SourceError::Other(why).into());
        }
        self.check_stranger()?;
        self.restored()?;
        self.ask_again();
        self.set_time();
        if let Some(posing) = &mut self.posing {
            posing.turn(&mut self.client)?;
        }
        let requests = self.client.take_requests();
        sent(&self.client, &requests)?;
        self.outgoing.add(&requests);
        let exchanged = self.exchange();
        self.original = self.source.port.original();
        self.source.port.gap().into_iter().for_each(|mark| mark.apply(&mut self.client));
        if let Some(news) = self.source.port.news() {
            let text = format!("{}: {news}", self.source.label);
            self.say(Level::Info, text);
        }
        match exchanged {
            Ok(true) => {
                self.set_time();
                let reported = self.source.port.own_requests();
                sent(&self.client, &reported)?;
                Ok(Turn::Bytes)
            }
            // Recordings and simulations end; a board streams as long as there is a link.
            Ok(false) if self.source.returns.is_none() => Ok(Turn::End),
            Ok(false) => self.lose(std::io::Error::other("the connection was closed").into()),
            Err(error) => self.lose(error),
        }
    }

    /// Bytes of the array in which the stream was perceived, of the last turn.
    pub fn original(&self) -> &[OriginalBytes] {
        &self.original
    }

    /// Bytes of the last turn.
    pub fn bytes(&self) -> &[u8] {
        &self.buffer
    }

    /// Next event of the last turn.
    pub fn next_event(&mut self) -> Option<Event> {
        let (count, event) = self.client.next_event(&self.buffer[self.taken..]);
        self.taken += count;
        let event = event?;
        if let Some(posing) = &mut self.posing {
            posing.event(&event);
        }
        if matches!(event, Event::Other { .. }) && !self.client.is_restoring() {
            // It is followed instead, and is on no robot that is known.
            (self.gap, self.posing) = (None, None);
        }
        Some(event)
    }

    /// Next event without handling further bytes: what the host itself has to say, once enough has come.
    pub fn note(&mut self) -> Option<Event> {
        self.client.next_event(&[]).1
    }

    pub(crate) fn say(&mut self, level: Level, text: String) {
        let time = self.client.board_time().unwrap_or(Micros(0));
        self.client.say(Event::Note { time, level, text });
    }

    fn set_time(&mut self) {
        let host_us = self.time.now_us();
        if self.source.real_time {
            self.client.set_time(host_us);
        }
        if let Some(posing) = &mut self.posing {
            // The clock of a simulation is what it said last.
            let board = self.client.board_time_at(host_us).or(self.client.board_time());
            posing.set_time(board, host_us);
        }
    }

    /// Writes and reads. Returns false at the end of the stream.
    fn exchange(&mut self) -> Result<bool> {
        self.outgoing.send(self.source.port.as_mut())?;
        if self.posing.is_none() && !self.client.awaits_time() {
            sleep(self.gather.pause(self.source.port.keeps(), self.heard.elapsed()));
        }
        self.buffer.resize(PIECE, 0);
        let read = self.source.port.read(&mut self.buffer);
        self.buffer.truncate(read.as_ref().ok().and_then(|count| *count).unwrap_or(0));
        let Some(count) = read? else { return Ok(false) };
        self.gather.read(count, PIECE);
        let now = Instant::now();
        if self.client.counts().messages == 0 {
            self.stranger.take(&self.buffer);
        }
        if count > 0 {
            self.heard = now;
        } else if self.source.real_time && self.client.description().is_some() && now - self.heard > SILENCE {
            fail!(SourceError::Silent, "it has sent nothing for {} s", SILENCE.as_secs());
        }
        if self.client.description().is_some() && !self.client.is_met() && now - self.opened > SILENCE {
            fail!(SourceError::Silent, "it has sent no Hello for {} s", SILENCE.as_secs());
        }
        Ok(true)
    }

    /// Error if what sends is no board.
    fn check_stranger(&self) -> Result<()> {
        let is_foreign = self.source.real_time && self.client.counts().messages == 0;
        match is_foreign && self.stranger.lasts() > FOREIGN {
            true => Err(SourceError::Foreign(self.stranger.describe(&self.source.label)).into()),
            false => Ok(()),
        }
    }

    /// Repeats requests to a board that has sent no `Hello`, or has not received them.
    fn ask_again(&mut self) {
        if !self.source.real_time || !self.source.listens {
            return;
        }
        if !self.client.is_met() && self.greeted.elapsed() > GREETING {
            self.greeted = Instant::now();
            self.client.ask_to_start();
        }
        if self.client.is_met() && self.client.is_overdue(ANSWER) {
            self.client.set_again();
        }
    }

    /// Handles the result of a restore.
    fn restored(&mut self) -> Result<()> {
        let Some(restored) = self.client.restored().filter(|_| self.source.listens) else { return Ok(()) };
        let label = &self.source.label;
        match restored {
            Restored::Refused(request, why) => {
                let request = request_name(request);
                let what = format!("{label}: after it came back, the board refuses {request}");
                return Err(SourceError::Refused { request, what, reason: why }.into());
            }
            Restored::Silent(request) => {
                let request = request_name(request);
                fail!(SourceError::Silent, "{label}: after it came back, the board does not answer {request}")
            }
            Restored::Done { set, untared } => {
                let mut names: Vec<&str> = set.iter().map(|number| request_name(*number)).collect();
                names.dedup();
                let untared = untared.map_or(String::new(), |why| format!("; no new tare: {why}"));
                let set = format!("set again: {}{untared}", names.join(", "));
                let Some(after) = self.gap.take().map(|gap| gap.elapsed()) else {
                    self.say(Level::Warn, format!("{label} has restarted, or missed requests; {set}"));
                    return Ok(());
                };
                let life = if self.client.has_lived_on() { "kept running" } else { "had restarted" };
                let seconds = after.as_secs_f64();
                let how = format!("{label} is back after {seconds:.1} s, and its board {life}; {set}");
                self.client.say(Event::Back { how, after });
            }
        }
        Ok(())
    }

    /// Handles a lost source.
    fn lose(&mut self, why: Error) -> Result<Turn> {
        let label = self.source.label.clone();
        if self.source.returns.is_none() || self.returns == Returns::Never {
            return Err(Error::caused(SourceError::Gone { label, patience: None }, why));
        }
        // A link that opens without bringing data does not end a gap.
        if self.gap.is_none() {
            let text = format!("{label} is gone: {}; waiting for it", crate::text::words::sentence(&why));
            let silent = u64::try_from(self.heard.elapsed().as_micros()).unwrap_or(u64::MAX);
            self.client.lost(text, self.time.now_us().saturating_sub(silent));
        }
        self.absence = Some(Absence::new(why, *self.gap.get_or_insert_with(Instant::now)));
        Ok(Turn::Waiting)
    }

    /// Waits briefly for the source, and tries to open it.
    fn come_back(&mut self) -> Result<Turn> {
        let Some(absence) = &mut self.absence else { return Ok(Turn::Waiting) };
        // Requests of this time reach nobody; lasting settings are remembered.
        self.client.take_requests();
        if let Returns::Within(patience) = self.returns
            && absence.lasts() > patience
        {
            let label = self.source.label.clone();
            let why = self.absence.take().map(Absence::why);
            let why = why.unwrap_or_else(|| Error::other("it is gone"));
            return Err(Error::caused(SourceError::Gone { label, patience: Some(patience) }, why));
        }
        if let Some(returns) = &mut self.source.returns
            && let Some(again) = absence.try_open(returns.as_mut())
        {
            self.absence = None;
            (self.source.label, self.source.port) = (again.label, again.port);
            self.client.linked(&self.source.label, again.usb_serial.as_deref());
            self.outgoing = Outgoing::default();
            (self.heard, self.greeted, self.opened) = (Instant::now(), Instant::now(), Instant::now());
            self.client.reconnected();
        }
        Ok(Turn::Waiting)
    }
}

/// Result of [`Session::poll`].
#[derive(Debug, Clone, PartialEq)]
pub enum Poll {
    /// An event.
    Event(Event),
    /// Nothing yet.
    Nothing,
    /// The stream has ended.
    End,
}

impl Iterator for Session {
    type Item = Result<Event>;

    fn next(&mut self) -> Option<Result<Event>> {
        self.wait().transpose()
    }
}
