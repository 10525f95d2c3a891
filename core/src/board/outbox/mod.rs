//! What waits to be sent, in the order of its urgency; encoded only when the link has room.

mod encoding;
mod noting;

use super::pace::{Pace, Rates};
use super::refusal::Refusal;
use super::under_way::UnderWay;
use super::{BoardInfo, Setup};
use super::{Codes, Sentence};
use crate::boot::Boot;
use crate::condition::{Certificate, Image};
use crate::format::{Celsius, Code, Micros, Q15};
use crate::health::Monitor;
use crate::pipeline::{CONTACTS, Probe, Stage};
use crate::react::REACTIONS;
use crate::scene::StreamConfig;
use crate::shape::Taught;
use crate::unsure::UnsureState;
use crate::wire::*;
use core::fmt;
use heapless::{Deque, Vec};

/// What the board is, wears and knows of it.
#[derive(Clone, Copy)]
pub(super) struct About<'a> {
    pub info: &'a BoardInfo,
    /// How it came to start.
    pub boot: Option<Boot>,
    pub setup: &'a Setup,
    pub monitor: &'a Monitor,
    /// The last self-test of lines and inputs.
    pub examined: Option<&'a SelfTestReport>,
    /// The calibration in force.
    pub certificate: Option<&'a Certificate>,
    /// Contacts that may be drift.
    pub unsure: &'a UnsureState<CONTACTS>,
    /// What it was taught.
    pub taught: &'a Taught<CONTACTS>,
}

/// Gestures that wait, each with its confidence until that is told.
type Gestures = Deque<(GestureReport, Option<Q15>), 4>;

/// What waits to be sent.
pub(super) struct Outbox<const TAXELS: usize> {
    under_way: UnderWay,
    streaming: bool,
    hello: Option<Micros>,
    /// A `Hello` has gone; how the board came to start is told next.
    greeted: bool,
    synced: Deque<(u32, Micros), 4>,
    answers: Deque<(u8, Option<Refusal>), 8>,
    logs: Deque<(Level, Sentence), 4>,
    reactions: Deque<ReactionReport, 16>,
    reflexes: Deque<ReflexReport, REACTIONS>,
    changes: Deque<IntentReport, 4>,
    gestures: Gestures,
    intent: Option<IntentReport>,
    symbols: SymbolList,
    symbols_wait: bool,
    contacts: ContactList,
    contacts_wait: bool,
    /// How old the forms of `contacts` are, one by one; of those that have gone, 0.
    ages: Vec<u8, LISTED>,
    /// That is asked for, and one of them is older than its frame.
    ages_wait: bool,
    tell_ages: bool,
    /// It is to be told which contacts are unsure.
    unsure: bool,
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
    /// Raw codes a second that were asked for beside the scene.
    raw_hz: u16,
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
            greeted: false,
            synced: Deque::new(),
            answers: Deque::new(),
            logs: Deque::new(),
            reactions: Deque::new(),
            reflexes: Deque::new(),
            changes: Deque::new(),
            gestures: Deque::new(),
            intent: None,
            symbols: SymbolList { frame: 0, time: Micros(0), events: Vec::new(), regions: Vec::new() },
            symbols_wait: false,
            contacts: ContactList { frame: 0, time: Micros(0), dropped: 0, contacts: Vec::new() },
            contacts_wait: false,
            ages: Vec::new(),
            ages_wait: false,
            tell_ages: false,
            unsure: false,
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
            raw_hz: 0,
            rates: Rates::of(stream, 0),
        }
    }

    /// What is streamed from now on, and how often.
    pub fn pace(&mut self, stream: &StreamConfig) {
        self.rates = Rates::of(stream, self.raw_hz);
    }

    /// So many raw codes a second are asked for beside what the scene streams.
    pub fn send_raw(&mut self, hz: u16, stream: &StreamConfig) {
        self.raw_hz = hz;
        self.pace(stream);
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

    /// It is to be told which contacts are unsure.
    pub fn tell_unsure(&mut self) {
        self.unsure = true;
    }

    /// Whether it is to be told from now on how old forms are.
    pub fn tell_ages(&mut self, ages: bool) {
        self.tell_ages = ages;
    }

    /// What the board was taught is to be told.
    pub fn tell_shapes(&mut self) {
        self.shapes = true;
    }

    /// Another base of shapes: it is to be told, and what waits was recognised by the one before.
    pub fn shapes_changed(&mut self) {
        self.shapes = true;
        self.contacts.contacts.iter_mut().for_each(|placed| placed.shape.forget_class());
    }

    /// The map of health is to be told.
    pub fn map_changed(&mut self) {
        self.map = Some(0);
    }

    /// `Stop`: nothing of a frame that is not under way.
    pub fn stop(&mut self) {
        self.streaming = false;
        self.hello = None;
        self.reactions.clear();
        self.drop_waiting();
    }

    /// Another garment: nothing of the old one, and `Hello` tells of the new one, then what a self-test finds
    /// in it.
    pub fn renew(&mut self) {
        self.hello = Some(Micros(0));
        self.examined |= self.streaming;
        self.forget_image();
        self.image.last.clear();
        self.drop_waiting();
    }

    /// What was felt; not the reactions: nobody else tells that they ended.
    fn drop_waiting(&mut self) {
        self.reflexes.clear();
        self.gestures.clear();
        self.forget_meaning();
        (self.image.due, self.raw) = (None, None);
        (self.budget, self.temperature) = (None, None);
        self.contacts.contacts.clear();
        (self.symbols_wait, self.contacts_wait, self.ages_wait, self.unsure) = (false, false, false, false);
    }

    /// Another map: what the old one made of a touch would be read as the new one's concepts.
    pub fn forget_meaning(&mut self) {
        self.changes.clear();
        self.intent = None;
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
        let next = if self.streaming { &mut self.health } else { &mut self.hello };
        next.get_or_insert(Micros(now.0.saturating_add(SECOND)));
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
}
