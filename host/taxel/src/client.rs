//! The host's end of the wire: takes bytes in any split, returns events, and keeps the state of the garment.
//!
//! ```
//! use taxel::client::{Client, Event};
//!
//! let mut client = Client::new();
//! client.start(16).unwrap();
//! let to_the_board = client.take_requests();
//! assert!(!to_the_board.is_empty());
//! for byte in b"\x00garbage\x00" {
//!     if let Some(Event::Refused(why)) = client.push(*byte) {
//!         println!("{why}"); // and the next frame is read as if nothing had been
//!     }
//! }
//! assert_eq!(client.counts().refused(), 1);
//! ```

mod again;
mod buses;
pub mod cleaned;
pub mod clock;
mod counts;
mod description;
mod event;
pub mod growths;
mod held;
mod identity;
mod known;
mod life;
mod loss;
mod ongoing;
pub mod passed;
mod picture;
mod requests;
mod restart;
mod retained_state;
mod scene_change;
mod stamps;
mod syncs;
mod time;
mod wanted;

pub use again::Restored;
pub use buses::Buses;
pub use counts::Counts;
pub use description::{BoardDescription, SIMULATED, is_simulated};
pub use event::{Event, ImageNews};
pub use identity::Identity;
pub use known::leads;
pub use requests::{request_name, scene_bytes};
pub use retained_state::RetainedState;
pub use scene_change::SceneChange;
pub(crate) use stamps::NS;
pub use stamps::{Stamp, Stamps, time_of};

use crate::client::growths::Growths;
use crate::files::calibrate::{ForceScale, Newtons};
use crate::text::words::printable;
use held::{Beside, HeldRequest};
use life::Life;
use ongoing::Ongoing;
use picture::Picture;
use std::collections::{BTreeMap, VecDeque};
use syncs::Syncs;
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::Celsius;
use taxel_core::health::TaxelHealth;
use taxel_core::scene::Scene;
use taxel_core::symbol::RegionState;
use taxel_core::wire::{
    Answer, Budget, ContactList, Frame, GestureReport, Health, HealthMap, Hello, IntentReport, REPORTS, Raw,
    Receiver, Report, Request, SelfTestReport, ShapesReport, WireError, decode, decode_image,
};

/// Longest frame from a board.
const LONGEST_REPORT: usize = 8192;
/// Number of the request that brings a piece of a table.
const SET_TABLE: u8 = Request::SetTable(&[]).number();
/// Most ids of released contacts kept: those of 16 full lists.
const RELEASED: usize = 1024;
/// Most events of the host's own that wait.
const OWN: usize = 64;

/// State of one board, built from its messages.
#[derive(Debug, Clone)]
pub struct Client {
    receiver: Box<Receiver<LONGEST_REPORT>>,
    message: Vec<u8>,
    /// Bytes since the last 0x00.
    line: Vec<u8>,
    /// Messages before these bytes that have brought no event.
    unheard: Vec<u8>,
    /// The last message has brought an event.
    is_heard: bool,
    /// Events of the host's own, and one of the board that comes after them.
    own: VecDeque<Event>,
    next: Option<Event>,
    /// The last event was the host's own.
    is_own: bool,
    requests: Vec<u8>,
    /// Requests held back until the board has answered others.
    held: VecDeque<HeldRequest>,
    beside: Beside,
    /// Scene of the board until its `Hello`, if it is known.
    expected: Option<Scene>,
    counts: Counts,
    syncs: Syncs,
    streaming: bool,
    life: Life,
    identity: Identity,
    /// Any other board is refused.
    is_only: bool,
    /// Short name of the source, and the serial number on USB that its link has now.
    link: (String, Option<String>),
    scale: ForceScale,
    /// Newtons by that scale on the garment.
    newtons: Option<Newtons>,
    description: Option<BoardDescription>,
    picture: Picture,
    raw: Vec<u16>,
    contacts: Vec<Placed>,
    growths: Growths,
    ongoing: Ongoing,
    released: Vec<u32>,
    /// The releases belong to a frame that was reported.
    is_reported: bool,
    regions: Vec<RegionState>,
    intention: Option<IntentReport>,
    /// Last report with the announced intention in the lead.
    led: Option<IntentReport>,
    /// Gesture reported last.
    gesture: Option<GestureReport>,
    /// Ids of contacts that may be drift.
    unsure: Vec<u32>,
    /// Ages of the forms that are older than the latest list of contacts, by their ids.
    form_ages: Vec<(u32, u8)>,
    /// Frame of the latest list of contacts.
    contacts_of: u32,
    health: Option<Health>,
    budget: Option<Budget>,
    celsius: Option<Celsius>,
    faulty: BTreeMap<u16, TaxelHealth>,
    self_test: Option<SelfTestReport>,
    /// Classes taught to the board; empty while the built-in base is in use.
    shapes: Vec<String>,
    /// Names of the surface's regions.
    surface_regions: Vec<String>,
}

impl Default for Client {
    fn default() -> Self {
        Client::new()
    }
}

impl Client {
    /// A client without any state.
    pub fn new() -> Client {
        Client {
            receiver: Box::new(Receiver::new()),
            message: Vec::new(),
            line: Vec::new(),
            unheard: Vec::new(),
            is_heard: false,
            own: VecDeque::new(),
            next: None,
            is_own: false,
            // Terminates a partial frame that the board may have received before.
            requests: vec![0],
            held: VecDeque::new(),
            beside: Beside::default(),
            expected: None,
            counts: Counts::default(),
            syncs: Syncs::default(),
            streaming: false,
            life: Life::default(),
            identity: Identity::default(),
            is_only: false,
            link: Default::default(),
            scale: ForceScale::default(),
            newtons: None,
            description: None,
            picture: Picture::default(),
            raw: Vec::new(),
            contacts: Vec::new(),
            growths: Growths::default(),
            ongoing: Ongoing::default(),
            released: Vec::new(),
            is_reported: false,
            regions: Vec::new(),
            intention: None,
            led: None,
            gesture: None,
            unsure: Vec::new(),
            form_ages: Vec::new(),
            contacts_of: 0,
            health: None,
            budget: None,
            celsius: None,
            faulty: BTreeMap::new(),
            self_test: None,
            shapes: Vec::new(),
            surface_regions: Vec::new(),
        }
    }

    /// Handles one byte. If it completes a message, updates the state and returns the event.
    pub fn push(&mut self, byte: u8) -> Option<Event> {
        self.push_all(&[byte]).1
    }

    /// Handles bytes up to the end of the first message that is an event, or all of them. Returns how many it
    /// handled, and the event; the state includes it.
    pub fn push_all(&mut self, bytes: &[u8]) -> (usize, Option<Event>) {
        let mut handled = 0;
        while let Some(rest @ [_, ..]) = bytes.get(handled..) {
            let (count, ended) = self.receiver.take(rest);
            let message = ended.map(|ended| {
                ended.map(|bytes| {
                    self.message.clear();
                    self.message.extend_from_slice(bytes);
                })
            });
            handled += count;
            self.counts.bytes += count as u64;
            self.keep(&rest[..count]);
            if let Some(event) = message.and_then(|message| self.end(message)) {
                return (handled, Some(event));
            }
        }
        (handled, None)
    }

    /// Handles bytes as [`Client::push_all`] does. Returns what the host itself has to say before the event that follows
    /// it: the end of what was present, after a restart and when the link is lost.
    pub fn next_event(&mut self, bytes: &[u8]) -> (usize, Option<Event>) {
        let mut count = 0;
        if self.own.is_empty() && self.next.is_none() {
            (count, self.next) = self.push_all(bytes);
        }
        self.is_own = !self.own.is_empty();
        (count, self.own.pop_front().or_else(|| self.next.take()))
    }

    /// Adds an event of the host's own; of many that nobody takes the oldest are dropped.
    pub(crate) fn say(&mut self, event: Event) {
        self.own.push_back(event);
        self.own.drain(..self.own.len().saturating_sub(OWN));
    }

    /// Handles the end of a message. No event, if it belongs to the next one.
    fn end(&mut self, message: Result<(), WireError>) -> Option<Event> {
        let bytes = std::mem::take(&mut self.message);
        let event = message.and_then(|()| self.read(&bytes)).unwrap_or_else(|error| {
            self.counts.refuse(error);
            Some(Event::Refused(error))
        });
        self.message = bytes;
        self.is_heard = event.is_some();
        event
    }

    /// Restarts the counters: earlier messages were assembled from parts of a recording.
    pub fn recount(&mut self) {
        self.counts = Counts::default();
    }

    /// Keeps bytes up to the end of a message for [`Client::line`]; only the beginning of an overlong frame is
    /// kept, and of what brings no event.
    fn keep(&mut self, bytes: &[u8]) {
        for part in bytes.split_inclusive(|byte| *byte == 0) {
            if self.line.last() == Some(&0) {
                if self.is_heard {
                    self.unheard.clear();
                } else if self.unheard.len() < LONGEST_REPORT {
                    self.unheard.extend_from_slice(&self.line);
                }
                self.is_heard = false;
                self.line.clear();
            }
            let body = part.strip_suffix(&[0]).unwrap_or(part);
            let room = LONGEST_REPORT.saturating_sub(self.line.len());
            self.line.extend_from_slice(&body[..body.len().min(room)]);
            self.line.extend_from_slice(&part[body.len()..]);
        }
    }

    /// Handles the message of an intact frame. No event, if it belongs to the next one.
    fn read(&mut self, message: &[u8]) -> Result<Option<Event>, WireError> {
        let (seq, rest) = postcard::take_from_bytes::<u32>(message).map_err(|_| WireError::Message)?;
        let (number, body) = postcard::take_from_bytes::<u32>(rest).map_err(|_| WireError::Message)?;
        if self.life.reopened && number != Report::HELLO {
            // Another board may be at the link now: what it says belongs to nothing. If it is the same one, these
            // messages count as lost, because nobody gets them.
            self.line.clear();
            return Ok(None);
        }
        if self.counts.sequence(seq) {
            self.stepped_back();
        }
        // A report is moved with the room of the longest one, 8 KiB. Images, the most frequent, are read without.
        if number == Report::FRAME {
            let (_, frame) = decode::<(u32, Frame<'_>)>(rest)?;
            self.understood(true);
            return Ok(Some(self.take_frame(&frame)));
        }
        if number as usize >= REPORTS.len() {
            // A later version's: it is counted, and says nothing here.
            self.understood(true);
            return Ok(None);
        }
        if number == Report::HELLO
            && let Some(Err(why)) = Hello::protocol_of(body).map(BoardDescription::speaks)
        {
            // Whatever else it holds is not this protocol's.
            self.understood(false);
            return Ok(Some(Event::Unusable(why)));
        }
        let report: Report<'_> = decode(rest)?;
        self.understood(number != Report::HELLO);
        Ok(self.take(report))
    }

    /// A message could be decoded.
    fn understood(&mut self, is_spoken: bool) {
        self.counts.messages += 1;
        if is_spoken {
            self.spoken();
        }
    }

    /// Ends what was present, and discards the state from before a restart of the board.
    fn forget(&mut self) {
        self.end_all();
        // Its contacts are counted anew.
        self.ongoing = Ongoing::default();
        self.faulty.clear();
        self.self_test = None;
    }

    /// No event, if the report belongs to the next one.
    fn take(&mut self, report: Report<'_>) -> Option<Event> {
        Some(match report {
            Report::Hello(hello) => return self.take_hello(&hello),
            Report::Frame(frame) => self.take_frame(&frame),
            Report::Contacts(ref list) => self.take_contacts(list),
            Report::Symbols(mut list) => {
                self.ongoing.symbols(&mut list);
                self.regions = list.regions.to_vec();
                Event::Symbols(Box::new(list))
            }
            Report::Intent(report) => self.take_intent(report),
            Report::Gesture(mut report) => {
                cleaned::name(&mut report.name);
                self.gesture = Some(report.clone());
                Event::Gesture(report)
            }
            Report::Pressing(mut report) => {
                report.links.iter_mut().for_each(|wrench| cleaned::name(&mut wrench.name));
                self.ongoing.pressing(&report);
                Event::Pressing(Box::new(report))
            }
            Report::RegionNames(names) => {
                let names = names.names.iter().map(|name| printable(name).into_owned());
                self.surface_regions = names.collect();
                return None;
            }
            Report::Regions(report) => {
                self.ongoing.regions(&report);
                Event::Regions(Box::new(report))
            }
            Report::Folds(report) => Event::Folds(Box::new(report)),
            Report::Shapes(report) => self.take_shapes(&report),
            Report::Reaction(mut report) => {
                cleaned::name(&mut report.reaction.name);
                self.ongoing.reaction(&report.reaction);
                Event::Reaction(report)
            }
            Report::Reflex(report) => Event::Reflex(report),
            Report::Health(health) => self.take_health(health),
            Report::Log(log) => {
                Event::Log { time: log.time, level: log.level, text: printable(log.text).into_owned() }
            }
            Report::Sync(report) => {
                self.syncs.take(&report);
                Event::Sync(report)
            }
            Report::StartOfFrame(start) => {
                self.syncs.start_of_frame(&start);
                Event::StartOfFrame(start)
            }
            Report::Answer(answer) => self.take_answer(&answer),
            Report::Raw(raw) => self.take_raw(&raw),
            Report::Budget(budget) => {
                self.budget = Some(budget);
                Event::Budget(budget)
            }
            Report::HealthMap(map) => self.take_map(&map),
            Report::Temperature(temperature) => {
                self.celsius = Some(temperature.celsius);
                Event::Temperature(temperature)
            }
            Report::SelfTest(report) => {
                self.self_test = Some(report.clone());
                Event::SelfTest(report)
            }
        })
    }

    fn take_intent(&mut self, report: IntentReport) -> Event {
        if leads(self.concepts(), &report) {
            self.led = Some(report.clone());
        }
        self.intention = Some(report.clone());
        Event::Intent(Box::new(report))
    }

    fn take_shapes(&mut self, report: &ShapesReport) -> Event {
        self.shapes = report.names.iter().map(|name| printable(name).into_owned()).collect();
        self.contacts.iter_mut().for_each(|placed| placed.shape.forget_class());
        Event::Shapes { names: self.shapes.clone(), prototypes: report.prototypes }
    }

    fn take_health(&mut self, health: Health) -> Event {
        self.health = Some(health);
        self.note_time(health.time);
        Event::Health(health)
    }

    fn take_answer(&mut self, answer: &Answer<'_>) -> Event {
        let refusal = answer.refusal.map(|why| printable(why).into_owned());
        self.answered(answer.request, refusal.as_deref());
        if refusal.is_some() && answer.request == SET_TABLE {
            // The pieces that follow would be refused, too.
            self.held.retain(|held| !held.is_piece());
        }
        Event::Answer { request: answer.request, refusal }
    }

    /// No event of a board that is refused.
    fn take_hello(&mut self, hello: &Hello<'_>) -> Option<Event> {
        Some(match BoardDescription::read(hello) {
            Ok(description) => {
                if !self.greeted(&description) {
                    self.line.clear();
                    return None;
                }
                if self.description.as_ref().is_none_or(|before| before.garment != description.garment) {
                    self.forget();
                }
                if self.concepts() != description.concepts() {
                    // Activations belong to the concepts of the scene before.
                    (self.intention, self.led) = (None, None);
                }
                self.description = Some(description);
                self.weigh();
                Event::Hello
            }
            Err(why) => Event::Unusable(why),
        })
    }

    fn take_frame(&mut self, frame: &Frame<'_>) -> Event {
        let every = self
            .description
            .as_ref()
            .is_some_and(|description| description.scene.stream.frames_hz == u16::MAX);
        self.counts.frame(frame.frame, every);
        self.note_time(frame.time);
        if self.is_reported {
            self.released.clear();
        }
        self.is_reported = true;
        let taxels = self.layout().map_or(0, |layout| layout.taxels());
        let news = self.picture.take(frame, taxels);
        if self.picture.wants_key() {
            // A request of two bytes always fits.
            let _ = self.request(&Request::KeyFrame);
        }
        if news != ImageNews::Whole {
            self.counts.undecoded += 1;
        }
        Event::Frame { frame: frame.frame, time: frame.time, alone: frame.base.is_none(), image: news }
    }

    fn take_contacts(&mut self, list: &ContactList) -> Event {
        if std::mem::take(&mut self.is_reported) {
            self.released.clear();
        }
        let (gone, mut here): (Vec<_>, Vec<_>) =
            list.contacts.iter().cloned().partition(|p| p.contact.phase == Phase::Released);
        self.ongoing.contacts(&mut here);
        self.growths.feel(&here, &gone);
        self.released.extend(gone.iter().map(|p| p.contact.id));
        // A board that sends no images never completes the list.
        self.released.drain(..self.released.len().saturating_sub(RELEASED));
        self.contacts = here;
        self.contacts_of = list.frame;
        self.form_ages = list.form_ages.to_vec();
        let before = std::mem::replace(&mut self.unsure, list.unsure.to_vec());
        let doubted = self.unsure.iter().copied().filter(|id| !before.contains(id)).collect();
        Event::Contacts { frame: list.frame, time: list.time, dropped: list.dropped, released: gone, doubted }
    }

    fn take_map(&mut self, map: &HealthMap) -> Event {
        let taxels = self.layout().map_or(0, |layout| layout.taxels());
        let span = usize::from(map.first)..usize::from(map.end);
        self.faulty.retain(|taxel, _| !span.contains(&usize::from(*taxel)));
        for faulty in &map.taxels {
            let end = faulty.first.saturating_add(faulty.count).min(map.end);
            self.faulty.extend((faulty.first.max(map.first)..end).map(|taxel| (taxel, faulty.health)));
        }
        Event::HealthMap { time: map.time, whole: span.end >= taxels }
    }

    fn take_raw(&mut self, raw: &Raw<'_>) -> Event {
        self.raw.resize(self.layout().map_or(0, |layout| layout.taxels()), 0);
        let whole = decode_image(raw.data, None, &mut self.raw).is_ok();
        if !whole {
            self.raw.clear();
            self.counts.undecoded += 1;
        }
        Event::Raw { frame: raw.frame, time: raw.time, whole }
    }
}
