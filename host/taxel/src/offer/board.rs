//! Publishes what a board says.

use super::asks::Asks;
use super::state::OfferState;
use crate::client::{Client, Event, Stamp};
use crate::error::{Error, Result, SourceError, UsageError};
use crate::json;
use crate::network::{self, BoardPlace, FrameCutter, PieceKind, PieceStamp};
use crate::session::Observer;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::{Publisher, Subscriber};
use zenoh::qos::{CongestionControl, Priority};
use zenoh::query::Queryable;
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Session, Wait};

/// Time in which another program that offers the board makes itself known.
const RIVALS: Duration = Duration::from_secs(1);
/// Most of them that are reported.
const MOST_REPORTED: usize = 64;

/// An offered board: a receiver of its stream.
pub struct BoardOffer {
    place: BoardPlace,
    session: Session,
    cutter: FrameCutter,
    stamp: PieceStamp,
    main: Wire,
    images: Wire,
    state_key: Publisher<'static>,
    health_key: Publisher<'static>,
    state: OfferState,
    /// The state as JSON, for whoever asks.
    reported: Arc<Mutex<String>>,
    asks: Arc<Asks>,
    /// There while the board is.
    token: Option<LivelinessToken>,
    /// Error because of which something could not be published.
    failed: Option<Error>,
    _queryables: [Queryable<()>; 2],
    _rivals: Subscriber<()>,
}

/// A way of frames.
struct Wire {
    publisher: Publisher<'static>,
    /// Somebody listens.
    is_watched: Arc<AtomicBool>,
}

impl Wire {
    fn open(session: &Session, key: String, kind: PieceKind) -> zenoh::Result<Wire> {
        let (control, priority) = match kind {
            PieceKind::Main => (CongestionControl::Block, Priority::InteractiveHigh),
            PieceKind::Image => (CongestionControl::Drop, Priority::DataLow),
        };
        let publisher = session.declare_publisher(key).congestion_control(control).priority(priority);
        let publisher = publisher.express(kind == PieceKind::Main).wait()?;
        let is_watched = Arc::new(AtomicBool::new(publisher.matching_status().wait()?.matching()));
        let reported = is_watched.clone();
        let listener = publisher.matching_listener();
        listener
            .callback(move |status| reported.store(status.matching(), Ordering::Relaxed))
            .background()
            .wait()?;
        Ok(Wire { publisher, is_watched })
    }

    /// True if somebody listens. The listener hears of a new one a while after frames go there: it is asked for, so
    /// that no image is left out behind the first frame of the other way.
    fn is_watched(&self) -> bool {
        self.is_watched.load(Ordering::Relaxed)
            || self.publisher.matching_status().wait().is_ok_and(|status| status.matching())
    }
}

impl BoardOffer {
    /// Offers a board by its name. Error if another program offers it already.
    pub fn open(session: &Session, place: &BoardPlace) -> Result<BoardOffer> {
        refuse_second(session, place)?;
        let publisher = fastrand::u64(..);
        let state = OfferState::new(place, publisher);
        BoardOffer::declare(session, place, publisher, state)
            .map_err(|why| error!(SourceError::NoBoard, "{place} cannot be offered: {}", network::said(&why)))
    }

    fn declare(
        session: &Session,
        place: &BoardPlace,
        publisher: u64,
        state: OfferState,
    ) -> zenoh::Result<BoardOffer> {
        let (asks, reported) = (Arc::new(Asks::default()), Arc::new(Mutex::new(line(&state))));
        let taken = asks.clone();
        let queries =
            session.declare_queryable(place.ask(publisher)).callback(move |query| taken.push(query));
        let (kept, key) = (reported.clone(), place.state());
        let states = session.declare_queryable(place.state()).callback(move |query| {
            let line = kept.lock().unwrap_or_else(PoisonError::into_inner).clone();
            drop(query.reply(&key, line).wait());
        });
        let rivals = session
            .liveliness()
            .declare_subscriber(place.all_alive())
            .callback(note_rivals(place.clone(), publisher));
        let plain = |key: String| session.declare_publisher(key).priority(Priority::DataHigh).wait();
        Ok(BoardOffer {
            place: place.clone(),
            session: session.clone(),
            cutter: FrameCutter::default(),
            stamp: PieceStamp { publisher, main: 0, images: 0 },
            main: Wire::open(session, place.main(), PieceKind::Main)?,
            images: Wire::open(session, place.images(), PieceKind::Image)?,
            state_key: plain(place.state())?,
            health_key: plain(place.health())?,
            state,
            reported,
            asks,
            token: None,
            failed: None,
            _queryables: [queries.wait()?, states.wait()?],
            _rivals: rivals.wait()?,
        })
    }

    /// Returns the publisher of the board: what the keys of requests and of signs of life end with.
    pub fn publisher(&self) -> u64 {
        self.stamp.publisher
    }

    /// Publishes the frames of an event; images only if somebody listens.
    fn publish(&mut self, client: &Client) {
        let BoardOffer { cutter, stamp, main, images, failed, .. } = self;
        let mut publish = |kind, frame: &[u8]| {
            let wire = match kind {
                PieceKind::Main => &*main,
                PieceKind::Image => &*images,
            };
            if kind == PieceKind::Image && !wire.is_watched() {
                return;
            }
            *stamp = stamp.next(kind);
            let put = wire.publisher.put(frame).attachment(stamp.to_bytes().as_slice()).wait();
            put.unwrap_or_else(|why| *failed = Some(of_zenoh(&why)));
        };
        client.lines().for_each(|line| cutter.push(line, &mut publish));
    }

    /// The board is there: says so, and what it is.
    fn meet(&mut self, client: &Client) -> zenoh::Result<()> {
        let Some(description) = client.description() else { return Ok(()) };
        self.state.meet(description);
        self.send_state()?;
        if self.token.is_none() {
            let token = self.session.liveliness().declare_token(self.place.alive(self.publisher()));
            self.token = Some(token.wait()?);
            log::info!("{} is offered as {:016x}", self.place, self.publisher());
        }
        Ok(())
    }

    /// The board is lost, or the stream has ended.
    fn part(&mut self) -> zenoh::Result<()> {
        self.cutter.reset();
        self.state.live = false;
        self.send_state()?;
        self.token.take().map_or(Ok(()), |token| token.undeclare().wait())
    }

    fn send_state(&mut self) -> zenoh::Result<()> {
        let line = line(&self.state);
        self.reported.lock().unwrap_or_else(PoisonError::into_inner).clone_from(&line);
        self.state_key.put(line).wait()
    }

    /// Handles what may fail.
    fn done(&mut self, done: zenoh::Result<()>) -> Result<()> {
        done.map_err(|why| of_zenoh(&why))?;
        self.failed.take().map_or(Ok(()), Err)
    }
}

impl Observer for BoardOffer {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<()> {
        self.publish(client);
        let done = match event {
            Event::Hello | Event::Back { .. } => self.meet(client),
            Event::Lost { .. } | Event::Other { .. } => self.part(),
            Event::Health(_) => match json::line(client, event).map(|reported| line(&reported)) {
                Some(reported) => self.health_key.put(reported).wait(),
                None => Ok(()),
            },
            _ => Ok(()),
        };
        self.done(done)
    }

    fn idle(&mut self, client: &mut Client) -> Result<()> {
        self.asks.hand_over(client, self.token.is_some());
        self.done(Ok(()))
    }

    fn ended(&mut self, _: &Client, _: Stamp) -> Result<()> {
        let parted = self.part();
        self.done(parted)
    }
}

/// Says who else offers the board, each once.
fn note_rivals(place: BoardPlace, publisher: u64) -> impl Fn(Sample) + Send + Sync {
    let reported = Mutex::new(Vec::new());
    move |sample| {
        let Some(id) = BoardPlace::publisher(sample.key_expr().as_str()) else { return };
        let mut reported = reported.lock().unwrap_or_else(PoisonError::into_inner);
        let is_new = sample.kind() == SampleKind::Put && id != publisher && !reported.contains(&id);
        if is_new && reported.len() < MOST_REPORTED {
            reported.push(id);
            log::warn!(
                "{place} is offered by another program, too ({id:016x}): whoever follows it stays with the one that \
                 it has."
            );
        }
    }
}

/// Error if a board is offered by somebody.
fn refuse_second(session: &Session, place: &BoardPlace) -> Result<()> {
    let known = session.liveliness().get(place.all_alive()).timeout(RIVALS).wait();
    let known = known.map_err(|why| of_zenoh(&why))?;
    while let Ok(reply) = known.recv() {
        let Ok(sample) = reply.result() else { continue };
        if let Some(id) = BoardPlace::publisher(sample.key_expr().as_str()) {
            fail!(
                UsageError::Argument,
                "{place} is offered by another program ({id:016x}): give another name"
            );
        }
    }
    Ok(())
}

/// JSON in one line.
fn line(reported: &impl Serialize) -> String {
    serde_json::to_string(reported).unwrap_or_default()
}

fn of_zenoh(why: &zenoh::Error) -> Error {
    SourceError::NoBoard(network::said(why)).into()
}
