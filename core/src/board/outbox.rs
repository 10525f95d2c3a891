//! What waits to be sent, in the order of its urgency; encoded only when the link has room.

use super::pace::{Pace, Rates};
use super::setup::{BoardInfo, Setup};
use super::under_way::UnderWay;
use super::{Codes, Sentence};
use crate::condition::{Certificate, Image};
use crate::contact::Phase;
use crate::format::{Celsius, Code, Micros, Name};
use crate::garment::{Layout, PANELS};
use crate::gesture::Gesture;
use crate::health::Monitor;
use crate::pipeline::{CONTACTS, Percept, Probe, Stage};
use crate::scene::StreamConfig;
use crate::shape::Taught;
use crate::wire::*;
use core::fmt::{self, Write};
use heapless::{Deque, String, Vec};
use serde::Serialize;

/// What the board is, wears and knows of it.
#[derive(Clone, Copy)]
pub(super) struct About<'a> {
    pub info: &'a BoardInfo,
    pub setup: &'a Setup,
    pub monitor: &'a Monitor,
    /// The last self-test of lines and inputs.
    pub examined: Option<&'a SelfTestReport>,
    /// The calibration in force.
    pub certificate: Option<&'a Certificate>,
    /// What it was taught.
    pub taught: &'a Taught<CONTACTS>,
}

/// Why something is refused, as a sentence.
#[derive(Debug, Clone)]
pub(super) struct Refusal(Sentence);

impl Refusal {
    /// The sentence of an error.
    pub fn of(error: impl fmt::Display) -> Refusal {
        format_args!("{error}").into()
    }

    /// The sentence.
    pub fn sentence(&self) -> &str {
        &self.0
    }
}

impl From<fmt::Arguments<'_>> for Refusal {
    fn from(text: fmt::Arguments<'_>) -> Refusal {
        let mut sentence = Sentence::new();
        // What is too long is cut at the piece that does not fit.
        let _ = sentence.write_fmt(text);
        Refusal(sentence)
    }
}

/// What waits to be sent.
pub(super) struct Outbox<const TAXELS: usize> {
    under_way: UnderWay,
    streaming: bool,
    hello: Option<Micros>,
    synced: Deque<(u32, Micros), 4>,
    answers: Deque<(u8, Option<Refusal>), 8>,
    logs: Deque<(Level, Sentence), 4>,
    reactions: Deque<ReactionReport, 16>,
    changes: Deque<IntentReport, 8>,
    gestures: Deque<GestureReport, 4>,
    intent: Option<IntentReport>,
    symbols: SymbolList,
    symbols_wait: bool,
    contacts: ContactList,
    contacts_wait: bool,
    health: Option<Micros>,
    budget: Option<Budget>,
    temperature: Option<Temperature>,
    /// When the next temperature is due.
    warm: Pace,
    /// It is to be told what the board was taught.
    shapes: bool,
    /// First taxel of the next part of the map of health.
    map: Option<u16>,
    examined: bool,
    image: Waiting<TAXELS>,
    raw: Option<(u32, Micros)>,
    codes: Codes<TAXELS>,
    rates: Rates,
}

/// The image that waits, and the one that was sent last.
struct Waiting<const TAXELS: usize> {
    due: Option<(u32, Micros)>,
    base: Option<u32>,
    key: Micros,
    last: Reference<TAXELS>,
}

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Nothing waits yet.
    #[inline(never)]
    pub fn new(stream: &StreamConfig) -> Self {
        Outbox {
            under_way: UnderWay::new(),
            streaming: false,
            hello: Some(Micros(0)),
            synced: Deque::new(),
            answers: Deque::new(),
            logs: Deque::new(),
            reactions: Deque::new(),
            changes: Deque::new(),
            gestures: Deque::new(),
            intent: None,
            symbols: SymbolList { frame: 0, time: Micros(0), events: Vec::new(), regions: Vec::new() },
            symbols_wait: false,
            contacts: ContactList { frame: 0, time: Micros(0), dropped: 0, contacts: Vec::new() },
            contacts_wait: false,
            health: None,
            budget: None,
            temperature: None,
            warm: Pace::new(1),
            shapes: false,
            map: None,
            examined: false,
            image: Waiting { due: None, base: None, key: Micros(0), last: Reference::new() },
            raw: None,
            codes: Codes::new(),
            rates: Rates::of(stream),
        }
    }

    /// What is streamed from now on, and how often.
    pub fn pace(&mut self, stream: &StreamConfig) {
        self.rates = Rates::of(stream);
    }

    /// `Start`: `Hello`, then everything, beginning with a key frame.
    pub fn start(&mut self) {
        self.streaming = true;
        self.hello = Some(Micros(0));
        self.map_changed();
        self.examined = true;
        self.forget_image();
    }

    /// The self-test is to be told.
    pub fn examined(&mut self) {
        self.examined = true;
    }

    /// `Hello` is to be told anew.
    pub fn introduce(&mut self) {
        self.hello = Some(Micros(0));
    }

    /// What the board was taught is to be told.
    pub fn shapes_changed(&mut self) {
        self.shapes = true;
    }

    /// The map of health is to be told.
    pub fn map_changed(&mut self) {
        self.map = Some(0);
    }

    /// `Stop`: nothing of a frame that is not under way.
    pub fn stop(&mut self) {
        self.streaming = false;
        self.hello = None;
        self.drop_waiting();
    }

    /// Another garment: nothing of the old one, and `Hello` tells of the new one.
    pub fn renew(&mut self) {
        self.hello = Some(Micros(0));
        self.forget_image();
        self.image.last.clear();
        self.drop_waiting();
    }

    fn drop_waiting(&mut self) {
        self.reactions.clear();
        self.changes.clear();
        self.gestures.clear();
        (self.intent, self.image.due, self.raw) = (None, None, None);
        (self.budget, self.temperature) = (None, None);
        self.contacts.contacts.clear();
        (self.symbols_wait, self.contacts_wait) = (false, false);
    }

    /// The next image stands alone.
    pub fn forget_image(&mut self) {
        self.image.base = None;
    }

    pub fn answer(&mut self, request: u8, refusal: Option<Refusal>) {
        // A host that asks eight times without reading gets no ninth answer.
        let _ = self.answers.push_back((request, refusal));
    }

    /// Something does not work.
    pub fn log(&mut self, text: fmt::Arguments<'_>) {
        self.tell(Level::Error, text);
    }

    pub fn tell(&mut self, level: Level, text: fmt::Arguments<'_>) {
        let _ = self.logs.push_back((level, Refusal::from(text).0));
    }

    pub fn sync(&mut self, token: u32, now: Micros) {
        let _ = self.synced.push_back((token, now));
    }

    /// Once a second: `Hello` until `Start`, then `Health`.
    pub fn tick(&mut self, now: Micros) {
        const SECOND: u64 = 1_000_000;
        if self.streaming {
            self.health.get_or_insert(Micros(now.0 + SECOND));
        } else {
            self.hello.get_or_insert(Micros(now.0 + SECOND));
        }
    }

    /// Takes a report of the time, unless one waits.
    pub fn spend(&mut self, budget: impl FnOnce() -> Option<Budget>) {
        if self.streaming && self.budget.is_none() {
            self.budget = budget();
        }
    }

    /// Takes a temperature, once a second.
    pub fn warm(&mut self, time: Micros, celsius: Option<Celsius>) {
        let Some(celsius) = celsius else { return };
        if self.streaming && self.warm.due(time) {
            self.temperature = Some(Temperature { time, celsius });
        }
    }

    /// Takes what was perceived in a frame.
    pub fn note(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        if !self.streaming {
            return;
        }
        for reaction in percept.reactions.changes() {
            let report = ReactionReport { frame, time, reaction: reaction.clone() };
            health.lost += u32::from(self.reactions.push_back(report).is_err());
        }
        if let Some(meaning) = percept.meaning.as_ref().filter(|_| self.rates.intent) {
            let report = IntentReport {
                frame,
                time,
                leading: meaning.leading,
                outcome: meaning.outcome,
                steps: meaning.steps,
                concepts: meaning.activations.clone(),
            };
            if meaning.changed {
                health.lost += u32::from(self.changes.push_back(report).is_err());
                self.intent = None;
            } else {
                self.intent = Some(report);
            }
        }
        self.note_gesture(frame, time, percept, health);
        self.note_contacts(frame, time, percept, health);
        self.note_symbols(frame, time, percept, health);
        // What waits is encoded from the newest image and codes, so it bears their number.
        let due = self.rates.frames.due(time);
        health.thinned_frames += u32::from(due && self.image.due.is_some());
        if due || self.image.due.is_some() {
            self.image.due = Some((frame, time));
        }
        if self.rates.raw.due(time) || self.raw.is_some() {
            self.raw = Some((frame, time));
        }
    }

    fn note_gesture(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let Some((gesture, name)) = &percept.gesture else { return };
        let Gesture { touch, panel, class, score, lead, observed_ms, ended } = *gesture;
        let name = name.clone();
        let report =
            GestureReport { frame, time, touch, panel, class, name, score, lead, observed_ms, ended };
        health.lost += u32::from(self.gestures.push_back(report).is_err());
    }

    /// The newest state of each contact; onsets and releases stay until they are told.
    fn note_contacts(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let list = &mut self.contacts.contacts;
        let news = percept.present.iter().any(|p| p.contact.phase == Phase::Onset);
        let due = self.rates.contacts.due(time) && !percept.present.is_empty();
        if self.contacts_wait {
            health.thinned_contacts += u32::from(due);
        } else {
            list.clear();
        }
        let mut untold = Vec::<u32, LISTED>::new();
        for told_later in list.iter().filter(|p| p.contact.phase == Phase::Onset) {
            let _ = untold.push(told_later.contact.id);
        }
        list.retain(|old| {
            let present = percept.present.iter().any(|p| p.contact.id == old.contact.id);
            old.contact.phase == Phase::Released || (old.contact.phase == Phase::Onset && !present)
        });
        for placed in percept.present {
            let mut placed = placed.clone();
            if untold.contains(&placed.contact.id) {
                placed.contact.phase = Phase::Onset;
            }
            health.lost += u32::from(list.push(placed).is_err());
        }
        for placed in percept.released {
            health.lost += u32::from(list.push(placed.clone()).is_err());
        }
        self.contacts_wait |= due || news || !percept.released.is_empty();
        (self.contacts.frame, self.contacts.time) = (frame, time);
        self.contacts.dropped = percept.dropped;
    }

    fn note_symbols(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let events = percept.symbols.events();
        if !self.rates.symbols || (events.is_empty() && !self.symbols_wait) {
            return;
        }
        let list = &mut self.symbols;
        if !self.symbols_wait {
            list.events.clear();
        }
        for event in events {
            health.lost += u32::from(list.events.push(*event).is_err());
        }
        list.regions.clear();
        for region in percept.symbols.regions(PANELS).iter().filter(|region| region.contacts > 0) {
            // As many as there are.
            let _ = list.regions.push(*region);
        }
        (list.frame, list.time) = (frame, time);
        self.symbols_wait = true;
    }

    /// Keeps the codes of a frame that is to be sent raw.
    pub fn raw(&mut self, codes: &[Code], taxels: usize) {
        if self.raw.is_some() {
            self.codes.clear();
            let _ = self.codes.extend_from_slice(codes.get(..taxels).unwrap_or(codes));
        }
    }

    /// Encodes what is to be sent next, unless something is under way.
    pub fn prepare(
        &mut self,
        now: Micros,
        about: About<'_>,
        image: &Image<'_>,
        health: &mut Health,
        probe: &mut impl Probe,
    ) {
        if !self.has_rest() {
            probe.begin(Stage::Encode);
            self.next(now, about, image, health);
            probe.begin(Stage::Idle);
        }
    }

    /// What the link has not taken of the message under way.
    pub fn rest(&self) -> &[u8] {
        self.under_way.rest()
    }

    /// Whether there is any of it.
    pub fn has_rest(&self) -> bool {
        !self.rest().is_empty()
    }

    pub fn sent(&mut self, count: usize) {
        self.under_way.sent(count);
    }

    /// Encodes the most urgent message, if there is one. Its buffers are on the stack only meanwhile.
    #[inline(never)]
    fn next(&mut self, now: Micros, about: About<'_>, image: &Image<'_>, health: &mut Health) {
        let About { info, setup, monitor, examined, certificate, taught } = about;
        let under_way = &mut self.under_way;
        let fits = if let Some((token, received)) = self.synced.pop_front() {
            under_way.put(Report::SYNC, &SyncReport { token, received, sent: now })
        } else if self.hello.is_some_and(|due| due <= now) {
            self.hello = None;
            put_hello(under_way, now, info, setup, certificate)
        } else if let Some(report) = examined.filter(|_| core::mem::take(&mut self.examined)) {
            under_way.put(Report::SELF_TEST, report)
        } else if let Some((request, refusal)) = self.answers.pop_front() {
            let refusal = refusal.as_ref().map(|why| why.0.as_str());
            under_way.put(Report::ANSWER, &Answer { request, refusal })
        } else if let Some(report) = self.reactions.pop_front() {
            under_way.put(Report::REACTION, &report)
        } else if self.contacts_wait {
            self.contacts_wait = false;
            under_way.put(Report::CONTACTS, &self.contacts)
        } else if self.symbols_wait {
            self.symbols_wait = false;
            under_way.put(Report::SYMBOLS, &self.symbols)
        } else if let Some(report) = self.changes.pop_front().or_else(|| self.intent.take()) {
            under_way.put(Report::INTENT, &report)
        } else if let Some(report) = self.gestures.pop_front() {
            under_way.put(Report::GESTURE, &report)
        } else if core::mem::take(&mut self.shapes) {
            put_shapes(under_way, taught)
        } else if let Some((level, text)) = self.logs.pop_front() {
            under_way.put(Report::LOG, &Log { time: now, level, text: &text })
        } else if let Some(first) = self.map.take_if(|_| self.streaming) {
            self.put_map(now, first, setup.layout.taxels(), monitor)
        } else if self.health.is_some_and(|due| due <= now) {
            self.health = None;
            under_way.put(Report::HEALTH, &Health { time: now, ..*health })
        } else if let Some(budget) = self.budget.take() {
            under_way.put(Report::BUDGET, &budget)
        } else if let Some(temperature) = self.temperature.take() {
            under_way.put(Report::TEMPERATURE, &temperature)
        } else if let Some((frame, time)) = self.image.due.take() {
            self.put_image(frame, time, &setup.layout, image, health)
        } else if let Some((frame, time)) = self.raw.take() {
            self.put_raw(frame, time)
        } else {
            true
        };
        health.lost = health.lost.wrapping_add(u32::from(!fits));
    }

    /// A part of the map of health, as much as fits a message.
    #[inline(never)]
    fn put_map(&mut self, time: Micros, first: u16, taxels: usize, monitor: &Monitor) -> bool {
        let mut map = HealthMap { time, first, end: taxels as u16, taxels: Vec::new() };
        for ill in monitor.ill().iter().filter(|ill| ill.taxel >= first) {
            match map.taxels.last_mut() {
                Some(run) if run.health == ill.health && run.first + run.count == ill.taxel => run.count += 1,
                _ => {
                    if map.taxels.push(Ill { first: ill.taxel, count: 1, health: ill.health }).is_err() {
                        map.end = ill.taxel;
                        break;
                    }
                }
            }
        }
        self.map = (usize::from(map.end) < taxels).then_some(map.end);
        self.under_way.put(Report::HEALTH_MAP, &map)
    }

    /// `false`: it does not fit. An image whose code has no room is thinned.
    fn put_image(
        &mut self,
        frame: u32,
        time: Micros,
        layout: &Layout,
        image: &Image<'_>,
        health: &mut Health,
    ) -> bool {
        let Outbox { under_way, image: Waiting { base, key, last, .. }, rates, .. } = self;
        let against = base.filter(|_| time.since(*key) < rates.key_us);
        let Some(length) = last.advance(layout, image, against.is_none(), under_way.scratch()) else {
            last.clear();
            *base = None;
            health.thinned_frames += 1;
            return true;
        };
        let head = Frame { frame, time, base: against, sum: last.sum(), data: &[] };
        let fits = under_way.put_data(Report::FRAME, &head, length);
        *base = fits.then_some(frame);
        if fits && against.is_none() {
            *key = time;
        }
        fits
    }

    fn put_raw(&mut self, frame: u32, time: Micros) -> bool {
        let mut plain = [0; TAXELS];
        for (value, code) in plain.iter_mut().zip(&self.codes) {
            *value = code.0;
        }
        let plain = plain.get(..self.codes.len()).unwrap_or(&[]);
        let length = encode_image(plain, None, self.under_way.scratch());
        let head = Raw { frame, time, data: &[] };
        length.is_some_and(|length| self.under_way.put_data(Report::RAW, &head, length))
    }
}

/// As a [`ShapesReport`].
fn put_shapes(under_way: &mut UnderWay, taught: &Taught<CONTACTS>) -> bool {
    match taught.gallery() {
        Some(gallery) => under_way.put(Report::SHAPES, &(gallery.prototypes.len() as u16, &gallery.names)),
        None => under_way.put(Report::SHAPES, &(0u16, Vec::<Name, 0>::new())),
    }
}

fn put_hello(
    under_way: &mut UnderWay,
    now: Micros,
    info: &BoardInfo,
    setup: &Setup,
    certificate: Option<&Certificate>,
) -> bool {
    let mut calibration: String<48> = String::new();
    // Its longest form has 35 characters.
    let _ = certificate.map(|it| write!(calibration, "{it}"));
    let (mut clock, mut garment, mut scene) = ([0; 10], [0; 2048], [0; 2048]);
    let hello = Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment: written(&setup.garment, &mut garment),
        firmware: info.firmware.as_bytes(),
        clock: written(&now, &mut clock),
        scene: written(&setup.scene, &mut scene),
        calibration: calibration.as_bytes(),
    };
    under_way.put(Report::HELLO, &hello)
}

/// postcard of a value; nothing where it does not fit.
fn written<'a, T: Serialize>(value: &T, buffer: &'a mut [u8]) -> &'a [u8] {
    match postcard::to_slice(value, buffer) {
        Ok(bytes) => bytes,
        Err(_) => &[],
    }
}
