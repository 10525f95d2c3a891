//! Queues of messages by urgency; a message is encoded only when the link has room.

mod contacts;
mod encoding;
mod enqueue;

use super::pace::{Pace, Rates};
use super::refusal::{Refusal, Sentence};
use super::tx_frame::TxFrame;
use super::{BoardInfo, Setup};
use crate::body::Placed;
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
use contacts::ContactQueue;
use core::fmt;
use heapless::{Deque, Vec};

/// Parts of the board that messages describe.
#[derive(Clone, Copy)]
pub(super) struct About<'a> {
    pub info: &'a BoardInfo,
    /// How the board started.
    pub boot: Option<Boot>,
    pub setup: &'a Setup,
    pub monitor: &'a Monitor,
    /// The last self-test of lines and inputs.
    pub examined: Option<&'a SelfTestReport>,
    /// The calibration in force.
    pub certificate: Option<&'a Certificate>,
    /// Present contacts of the last frame.
    pub present: &'a [Placed],
    /// Age of their forms, frames, in the same order.
    pub form_ages: &'a [u8],
    /// True if the last frame took a picture of a contact's pattern.
    pub took_picture: bool,
    /// Contacts that may be drift.
    pub unsure: &'a UnsureState<CONTACTS>,
    /// Taught shapes.
    pub taught: &'a Taught<CONTACTS>,
}

/// Gestures to send, each with its confidence until that has been sent.
type GestureQueue = Deque<(GestureReport, Option<Q15>), 4>;

/// Raw codes to be sent, kept until the link has room.
#[cfg(feature = "raw")]
type CodeVec<const TAXELS: usize> = Vec<Code, TAXELS>;
#[cfg(not(feature = "raw"))]
type CodeVec<const TAXELS: usize> = Vec<Code, 0>;

/// Messages to send.
pub(super) struct Outbox<const TAXELS: usize> {
    tx_frame: TxFrame,
    streaming: bool,
    hello: Option<Micros>,
    /// True after a `Hello`: how the board started is sent next.
    greeted: bool,
    synced: Deque<(u32, Micros), 4>,
    /// True after a `Sync`, until the link was asked for the start of a frame.
    start_asked: bool,
    start_of_frame: Option<StartOfFrame>,
    answers: Deque<(u8, Option<Refusal>), 8>,
    logs: Deque<(Level, Sentence), 4>,
    reactions: Deque<ReactionReport, 16>,
    reflexes: Deque<ReflexReport, REACTIONS>,
    changes: Deque<IntentReport, 4>,
    gestures: GestureQueue,
    intent: Option<IntentReport>,
    symbols: SymbolList,
    symbols_wait: bool,
    contacts: ContactQueue,
    /// True if the lists of contacts and symbols that wait are those of the previous garment.
    parting: bool,
    /// True if ages are requested and one of them is above 0.
    ages_wait: bool,
    tell_ages: bool,
    /// True if the list of unsure contacts is to be sent.
    unsure: bool,
    health: Option<Micros>,
    budget: Option<Budget>,
    temperature: Option<Temperature>,
    /// Rate of temperature reports.
    warm: Pace,
    /// True if the taught shapes are to be sent.
    shapes: bool,
    /// First taxel of the next part of the health map.
    map: Option<u16>,
    examined: bool,
    image: Waiting<TAXELS>,
    raw: Option<(u32, Micros)>,
    codes: CodeVec<TAXELS>,
    /// Frames of raw codes per second that were requested beside the scene.
    raw_hz: u16,
    rates: Rates,
}

/// The image to send, and the one sent last.
struct Waiting<const TAXELS: usize> {
    due: Option<(u32, Micros)>,
    base: Option<u32>,
    /// Time of the last key frame.
    key: Micros,
    last: ImageReference<TAXELS>,
}

/// Parts of the present state: each is streamed or not.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Streamed {
    contacts: bool,
    symbols: bool,
    intent: bool,
}

/// Reports that are made when they are sent, of much that is summed up then: what presses, what folds.
type Slow<P, F> = (Option<P>, Option<F>);

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Nothing to send yet.
    #[inline(never)]
    pub fn new(stream: &StreamConfig) -> Self {
        Outbox {
            tx_frame: TxFrame::new(),
            streaming: false,
            hello: Some(Micros(0)),
            greeted: false,
            synced: Deque::new(),
            start_asked: false,
            start_of_frame: None,
            answers: Deque::new(),
            logs: Deque::new(),
            reactions: Deque::new(),
            reflexes: Deque::new(),
            changes: Deque::new(),
            gestures: Deque::new(),
            intent: None,
            symbols: SymbolList { frame: 0, time: Micros(0), events: Vec::new(), regions: Vec::new() },
            symbols_wait: false,
            contacts: ContactQueue::new(),
            parting: false,
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
            image: Waiting { due: None, base: None, key: Micros(0), last: ImageReference::new() },
            raw: None,
            codes: CodeVec::new(),
            raw_hz: 0,
            rates: Rates::of(stream, 0),
        }
    }

    /// Sets the rates of the stream.
    pub fn pace(&mut self, stream: &StreamConfig) {
        self.rates = Rates::of(stream, self.raw_hz);
    }

    /// Sets the raw codes requested per second beside the scene's stream.
    pub fn send_raw(&mut self, hz: u16, stream: &StreamConfig) {
        self.raw_hz = hz;
        self.pace(stream);
    }

    /// On `Start`: sends `Hello`, then everything, beginning with a key frame.
    pub fn start(&mut self) {
        self.streaming = true;
        self.hello = Some(Micros(0));
        self.map_changed();
        self.examined = true;
        self.forget_image();
    }

    /// Queues the result of the self-test.
    pub fn examined(&mut self) {
        self.examined = true;
    }

    /// Queues another `Hello`.
    pub fn introduce(&mut self) {
        self.hello = Some(Micros(0));
    }

    /// Queues the list of unsure contacts.
    pub fn tell_unsure(&mut self) {
        self.unsure = true;
    }

    /// Sets whether ages of forms are sent.
    pub fn tell_ages(&mut self, ages: bool) {
        self.tell_ages = ages;
    }

    /// Queues the taught shapes.
    pub fn tell_shapes(&mut self) {
        self.shapes = true;
    }

    /// The base of shapes has changed: queues it, and clears the classes of contacts that have ended, which
    /// are those of the previous base.
    pub fn shapes_changed(&mut self) {
        self.shapes = true;
        self.contacts.forget_classes();
    }

    /// Queues the health map.
    pub fn map_changed(&mut self) {
        self.map = Some(0);
    }

    /// Parts of the present state that are streamed.
    pub fn streamed(&self) -> Streamed {
        let contacts = self.streaming;
        Streamed { contacts, symbols: contacts && self.rates.symbols, intent: contacts && self.rates.intent }
    }

    /// On `Stop`: drops all queued data of frames but the ends of contacts; a message in transmission is
    /// completed.
    pub fn stop(&mut self) {
        self.streaming = false;
        self.hello = None;
        self.reactions.clear();
        self.drop_waiting();
    }

    /// The garment has changed: drops all data of the old one, and queues `Hello` and the next self-test.
    pub fn renew(&mut self) {
        self.hello = Some(Micros(0));
        self.examined |= self.streaming;
        self.forget_image();
        self.image.last.clear();
        self.drop_waiting();
    }

    /// Drops what was perceived. Ends of contacts and reactions stay, because nothing else would report them.
    fn drop_waiting(&mut self) {
        self.reflexes.clear();
        self.gestures.clear();
        (self.image.due, self.raw) = (None, None);
        (self.budget, self.temperature) = (None, None);
        (self.ages_wait, self.unsure) = (false, false);
    }

    /// Makes the next image a key frame.
    pub fn forget_image(&mut self) {
        self.image.base = None;
    }

    pub fn answer(&mut self, request: u8, refusal: Option<Refusal>) {
        // A host that sends eight requests without reading gets no ninth answer.
        let _ = self.answers.push_back((request, refusal));
    }

    /// Queues a log message of an error.
    pub fn log(&mut self, text: fmt::Arguments<'_>) {
        self.tell(Level::Error, text);
    }

    pub fn tell(&mut self, level: Level, text: fmt::Arguments<'_>) {
        let _ = self.logs.push_back((level, Refusal::from(text).0));
    }

    pub fn sync(&mut self, token: u32, now: Micros) {
        let _ = self.synced.push_back((token, now));
        self.start_asked = true;
    }

    /// True once after each `Sync`.
    pub fn asks_start_of_frame(&mut self) -> bool {
        core::mem::take(&mut self.start_asked)
    }

    /// Takes the start of a frame of the link.
    pub fn start_of_frame(&mut self, start: StartOfFrame) {
        self.start_of_frame = Some(start);
    }

    /// Queues once a second: `Hello` until `Start`, then `Health`.
    pub fn tick(&mut self, now: Micros) {
        const SECOND: u64 = 1_000_000;
        let next = if self.streaming { &mut self.health } else { &mut self.hello };
        next.get_or_insert(Micros(now.0.saturating_add(SECOND)));
    }

    /// Takes a time report, unless one is waiting.
    pub fn charge(&mut self, budget: impl FnOnce() -> Option<Budget>) {
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

    /// Stores the codes of a frame that is to be sent raw.
    pub fn raw(&mut self, codes: &[Code], taxels: usize) {
        if cfg!(feature = "raw") && self.raw.is_some() {
            self.codes.clear();
            let _ = self.codes.extend_from_slice(codes.get(..taxels).unwrap_or(codes));
        }
    }

    /// Encodes the next message, unless one is in transmission.
    pub fn prepare(
        &mut self,
        now: Micros,
        about: About<'_>,
        image: &Image<'_>,
        (pressing, folds): Slow<impl FnOnce(&mut TxFrame) -> bool, impl FnOnce() -> Option<FoldsReport>>,
        health: &mut Health,
        platform: &mut (impl Probe + Checksum),
    ) {
        if !self.has_rest() {
            platform.begin(Stage::Encode);
            self.next(now, about, image, (pressing, folds), health);
            self.tx_frame.close(platform);
            platform.begin(Stage::Idle);
        }
    }

    /// Bytes of the message in transmission that the link has not taken.
    pub fn rest(&self) -> &[u8] {
        self.tx_frame.rest()
    }

    /// True if a message is in transmission.
    pub fn has_rest(&self) -> bool {
        !self.rest().is_empty()
    }

    pub fn sent(&mut self, count: usize) {
        self.tx_frame.sent(count);
    }
}
