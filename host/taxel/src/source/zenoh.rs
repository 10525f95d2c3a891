//! A board that another machine offers over Zenoh: its frames by subscription, requests to it as queries.

use super::{Port, Source};
use crate::error::{Result, SourceError};
use crate::network::{self, BoardPlace, NetworkEnd, PieceKind, PieceOrder, WirePiece};
use crate::source::shared::Shared;
use crate::time::Instant;
use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use zenoh::pubsub::Subscriber;
use zenoh::qos::{CongestionControl, Priority};
use zenoh::query::{QueryTarget, Reply};
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Session, Wait};

/// Longest wait of a read.
const PATIENCE: Duration = Duration::from_millis(10);
/// Time for a publisher to be known: at the first time, and when it is looked for again.
const FIRST: Duration = Duration::from_secs(3);
const AGAIN: Duration = Duration::from_millis(300);
/// Longest wait for the answer that a request was handed over.
const HANDED: Duration = Duration::from_secs(3);
/// Most requests that wait for that.
const OPEN: usize = 16;
/// Bytes that are enough for a read.
const READY: usize = 1 << 16;
/// Most publishers that are known, and most news that wait.
const KNOWN: usize = 64;

/// Opens a board by its name. Error if nobody can be reached, or offers it.
pub fn open(place: &BoardPlace, config: Option<&Path>) -> Result<Source> {
    let session = network::open(NetworkEnd::Viewer, config)?;
    let network = Network { place: place.clone(), config: config.map(PathBuf::from), session };
    network.source(None, FIRST)
}

/// Means to look for a board.
struct Network {
    place: BoardPlace,
    config: Option<PathBuf>,
    session: Session,
}

impl Network {
    /// Opens the board, of the publisher that it had before if that is still there.
    fn source(mut self, before: Option<u64>, longest: Duration) -> Result<Source> {
        if self.session.is_closed() {
            self.session = network::open(NetworkEnd::Viewer, self.config.as_deref())?;
        }
        let label = format!("zenoh:{}", self.place);
        let port = ZenohPort::open(&self, before, longest)?;
        let publisher = port.publisher;
        let returns = move || {
            let Network { place, config, session } = &self;
            let again = Network { place: place.clone(), config: config.clone(), session: session.clone() };
            again.source(Some(publisher), AGAIN)
        };
        Ok(Source::real(label, port, returns))
    }
}

/// Messages that have come, and requests that are under way.
#[derive(Default)]
struct Inbox {
    /// Publishers that show signs of life.
    alive: Vec<u64>,
    /// Frames of the publisher; none before one is chosen.
    order: Option<PieceOrder>,
    /// News that are to be reported.
    news: VecDeque<String>,
    /// Requests that have no answer yet.
    open: usize,
    /// The last request that was answered was not handed over.
    is_unheard: bool,
    /// Ways by which something came that the publisher has not sent: it was reported.
    strange: Vec<PieceKind>,
    /// Nobody reads any longer.
    is_closed: bool,
}

impl Inbox {
    /// Adds what is to be reported, unless nobody has listened for long.
    fn report(&mut self, news: String) {
        if self.news.len() < KNOWN {
            self.news.push_back(news);
        }
    }
}

/// The link to a board.
struct ZenohPort {
    publisher: u64,
    ask: String,
    session: Session,
    inbox: Arc<Shared<Inbox>>,
    /// Bytes that are to be read.
    ready: VecDeque<u8>,
    /// A request that is not complete.
    begun: Vec<u8>,
    /// The publisher's signs of life, and its frames.
    _subscribers: [Subscriber<()>; 2],
}

impl ZenohPort {
    fn open(network: &Network, before: Option<u64>, longest: Duration) -> Result<ZenohPort> {
        let Network { place, session, .. } = network;
        let inbox = Arc::<Shared<Inbox>>::default();
        let reported = inbox.clone();
        let alive = session.liveliness().declare_subscriber(place.all_alive()).history(true);
        let alive = alive.callback(move |sample| note_life(&reported, &sample)).wait().map_err(failed)?;
        let publisher = chosen(&inbox, place, before, longest)?;
        let reported = inbox.clone();
        let (main, images) = (place.main(), place.images());
        let wire = session.declare_subscriber(place.wire()).callback(move |sample| {
            let kind = match sample.key_expr().as_str() {
                key if key == main => PieceKind::Main,
                key if key == images => PieceKind::Image,
                _ => return,
            };
            note_piece(&reported, kind, &sample);
        });
        Ok(ZenohPort {
            publisher,
            ask: place.ask(publisher),
            session: session.clone(),
            inbox,
            ready: VecDeque::new(),
            begun: Vec::new(),
            _subscribers: [alive, wire.wait().map_err(failed)?],
        })
    }

    /// Moves what is next to the bytes that are to be read; waits a short while if there is nothing. Returns false
    /// if the publisher is gone.
    fn collect(&mut self) -> bool {
        let until = Instant::now() + PATIENCE;
        let mut inbox = self.inbox.lock();
        loop {
            let now = Instant::now();
            let order = inbox.order.get_or_insert_with(|| PieceOrder::new(self.publisher));
            while self.ready.len() < READY
                && let Some(piece) = order.next(now)
            {
                self.ready.extend(piece.bytes);
            }
            let wait = order.wait(now).unwrap_or(PATIENCE).min(until.saturating_duration_since(now));
            if !self.ready.is_empty() {
                self.inbox.wake();
                return true;
            }
            if !inbox.alive.contains(&self.publisher) {
                return false;
            }
            if wait.is_zero() {
                return true;
            }
            inbox = self.inbox.wait(inbox, wait);
        }
    }

    /// Sends a request as a query.
    fn send(&self, request: &[u8]) -> io::Result<()> {
        self.inbox.lock().open += 1;
        let ticket = Ticket(self.inbox.clone());
        self.session
            .get(&self.ask)
            .payload(request)
            .target(QueryTarget::All)
            .timeout(HANDED)
            .congestion_control(CongestionControl::Block)
            .priority(Priority::InteractiveHigh)
            .express(true)
            .callback(move |reply| ticket.answered(&reply))
            .wait()
            .map_err(|why| io::Error::other(network::said(&why)))
    }
}

impl Port for ZenohPort {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        if self.ready.is_empty() && !self.collect() {
            return Ok(None);
        }
        let count = self.ready.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(self.ready.drain(..count)) {
            *slot = byte;
        }
        Ok(Some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut count = 0;
        for byte in bytes {
            if *byte == 0 && !self.begun.is_empty() {
                if self.inbox.lock().open >= OPEN {
                    break;
                }
                self.begun.push(0);
                let request = std::mem::take(&mut self.begun);
                self.send(&request)?;
            } else if *byte != 0 {
                self.begun.push(*byte);
            }
            count += 1;
        }
        Ok(count)
    }

    fn news(&mut self) -> Option<String> {
        self.inbox.lock().news.pop_front()
    }
}

impl Drop for ZenohPort {
    fn drop(&mut self) {
        self.inbox.change(|inbox| inbox.is_closed = true);
    }
}

/// A request without an answer; when all answers have come, or none will, it is dropped.
struct Ticket(Arc<Shared<Inbox>>);

impl Ticket {
    fn answered(&self, reply: &Reply) {
        let result = reply.result();
        let was_unheard = std::mem::replace(&mut self.0.lock().is_unheard, result.is_err());
        if let Err(why) = result
            && !was_unheard
        {
            let why = network::words(&why.payload().to_bytes());
            self.0.change(|inbox| inbox.report(format!("a request was not handed over: {why}")));
        }
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        self.0.change(|inbox| inbox.open -= 1);
    }
}

/// Notes that a publisher is there, or gone.
fn note_life(inbox: &Shared<Inbox>, sample: &Sample) {
    let Some(id) = BoardPlace::publisher(sample.key_expr().as_str()) else { return };
    inbox.change(|inbox| {
        inbox.alive.retain(|known| *known != id);
        if sample.kind() == SampleKind::Delete {
            return;
        }
        let ours = inbox.order.as_ref().map(PieceOrder::publisher);
        if inbox.alive.len() < KNOWN || ours == Some(id) {
            inbox.alive.push(id);
        }
        if let Some(ours) = ours.filter(|ours| *ours != id) {
            inbox.report(twice(ours, id));
        }
    });
}

/// Returns what is said if two programs offer a board.
fn twice(ours: u64, other: u64) -> String {
    format!("it is offered twice; {ours:016x} is followed, and {other:016x} is not")
}

/// Chooses a publisher: the one before, if it is there, else that of the lowest number, so that all choose the same.
fn chosen(inbox: &Shared<Inbox>, place: &BoardPlace, before: Option<u64>, longest: Duration) -> Result<u64> {
    let until = Instant::now() + longest;
    let mut known = inbox.lock();
    while known.alive.is_empty() {
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            fail!(SourceError::NoBoard, "zenoh:{place}: nobody in the network offers this board");
        }
        known = inbox.wait(known, left);
    }
    let before = before.filter(|before| known.alive.contains(before));
    let ours = before.or(known.alive.iter().min().copied()).unwrap_or_default();
    let others: Vec<u64> = known.alive.iter().copied().filter(|id| *id != ours).collect();
    others.into_iter().for_each(|other| known.report(twice(ours, other)));
    known.order = Some(PieceOrder::new(ours));
    Ok(ours)
}

/// Takes a frame; what the publisher has not sent is ignored, and reported once.
fn note_piece(inbox: &Shared<Inbox>, kind: PieceKind, sample: &Sample) {
    let stamp = sample.attachment().map(|bytes| bytes.to_bytes()).unwrap_or_default();
    let piece = WirePiece::read(kind, &stamp, &sample.payload().to_bytes());
    let mut known = inbox.lock();
    // The network waits with us, as a cable would.
    while kind == PieceKind::Main && !known.is_closed && known.order.as_ref().is_some_and(PieceOrder::is_full)
    {
        known = inbox.wait(known, PATIENCE);
    }
    let Some(order) = &mut known.order else { return };
    let taken = piece.and_then(|piece| order.push(Instant::now(), piece));
    if let Err(why) = taken
        && !known.strange.contains(&kind)
    {
        known.strange.push(kind);
        let key = sample.key_expr();
        known.report(format!("something else writes to {key}, and is ignored: {why}"));
    }
    drop(known);
    inbox.wake();
}

fn failed(why: zenoh::Error) -> SourceError {
    SourceError::NoBoard(network::said(&why))
}
