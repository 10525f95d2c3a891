//! Reports to send, by urgency; a report is encoded only when the link has room.

mod about;
mod contacts;
mod greeting;
mod health_map;
mod images;
mod latest;
mod reactions;
mod reports;

use super::pace::{Pace, Rates};
use super::refusal::{Refusal, Sentence};
use super::tx_frame::TxFrame;
use crate::body::Placed;
use crate::format::{Celsius, Code, Micros, Name};
use crate::garment::PANELS;
use crate::gesture::Gesture;
use crate::intent::{Leading, Meaning};
use crate::pipeline::{CONTACTS, Percept, Probe, Stage};
use crate::react::{REACTIONS, Reaction};
use crate::scene::StreamConfig;
use crate::symbol::{RegionState, SymbolState};
use crate::wire::*;
pub(super) use about::About;
use contacts::{ContactQueue, List};
use core::fmt;
use heapless::{Deque, Vec};
use images::{ImageQueue, RawQueue};
use latest::Latest;
use reactions::ReactionQueue;
pub(super) use reports::{Reports, only};
use serde::Serialize;

/// Reports that wait until the host asks for a stream.
const STREAMED: Reports = only(Report::HEALTH_MAP)
    | only(Report::REGION_NAMES)
    | only(Report::REGIONS)
    | only(Report::PRESSING)
    | only(Report::FOLDS);
/// Reports that wait for the ends of the contacts of the previous garment: they speak of the next one.
const OF_GARMENT: Reports = only(Report::HELLO) | only(Report::ANSWER);
/// Reports that end what a host knows of the previous garment.
const PARTING: Reports = only(Report::CONTACTS) | only(Report::SYMBOLS);

/// Reports to send.
pub(super) struct Outbox<const TAXELS: usize> {
    tx_frame: TxFrame,
    streaming: bool,
    /// Reports to send of which nothing else is kept here.
    flagged: Reports,
    /// Rate of `Hello`, and of `Health` while streaming.
    beat: Pace,
    synced: Deque<(u32, Micros), 4>,
    /// True after a `Sync`, until the link was asked for the start of a frame.
    start_asked: bool,
    answers: Deque<(u8, Option<Refusal>), 8>,
    logs: Deque<(Level, Sentence), 4>,
    reactions: ReactionQueue,
    reflexes: Deque<ReflexReport, REACTIONS>,
    /// Changes of the leading intention.
    changes: Deque<IntentReport, 4>,
    intent: Option<IntentReport>,
    gestures: Deque<GestureReport, 4>,
    symbols: SymbolList,
    contacts: ContactQueue,
    /// True if the lists of contacts and symbols that wait are those of the previous garment.
    parting: bool,
    latest: Latest,
    /// Rate of temperature reports.
    warm: Pace,
    /// First taxel of the next part of the health map.
    map: u16,
    image: ImageQueue<TAXELS>,
    raw: RawQueue<TAXELS>,
    rates: Rates,
}

/// Parts of the present state: each is streamed or not.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Streamed {
    contacts: bool,
    symbols: bool,
    intent: bool,
}

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Nothing to send but a `Hello`.
    #[inline(never)]
    pub fn new(stream: &StreamConfig) -> Self {
        let mut beat = Pace::new(1);
        beat.due(Micros(0));
        Outbox {
            tx_frame: TxFrame::new(),
            streaming: false,
            flagged: only(Report::HELLO),
            beat,
            synced: Deque::new(),
            start_asked: false,
            answers: Deque::new(),
            logs: Deque::new(),
            reactions: ReactionQueue::new(),
            reflexes: Deque::new(),
            changes: Deque::new(),
            intent: None,
            gestures: Deque::new(),
            symbols: SymbolList { frame: 0, time: Micros(0), events: Vec::new(), regions: Vec::new() },
            contacts: ContactQueue::new(),
            parting: false,
            latest: Latest::new(),
            warm: Pace::new(1),
            map: 0,
            image: ImageQueue::new(),
            raw: RawQueue::new(),
            rates: Rates::of(stream),
        }
    }

    /// Sets the rates of the scene's stream.
    pub fn pace(&mut self, stream: &StreamConfig) {
        self.rates = Rates::of(stream);
    }

    /// Sets the frames of raw codes per second.
    pub fn send_raw(&mut self, hz: u16) {
        self.raw.pace(hz);
    }

    /// Queues a report whose body is read when it is sent.
    pub fn flag(&mut self, number: u32) {
        self.flagged |= only(number);
    }

    /// Queues the newest state of a small report, unless an older one waits.
    pub fn note(&mut self, number: u32, report: &impl Serialize) {
        self.latest.put(number, report);
    }

    /// On `Start`: sends `Hello`, then everything, beginning with a key frame.
    pub fn start(&mut self) {
        self.streaming = true;
        self.flag(Report::HELLO);
        self.flag(Report::SELF_TEST);
        self.map_changed();
        self.forget_image();
    }

    /// The base of shapes has changed: queues it, and clears the classes of contacts that have ended, which
    /// are those of the previous base.
    pub fn shapes_changed(&mut self) {
        self.flag(Report::SHAPES);
        self.contacts.forget_classes();
    }

    /// Queues the health map.
    pub fn map_changed(&mut self) {
        self.map = 0;
        self.flag(Report::HEALTH_MAP);
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
        self.flagged &= !only(Report::HELLO);
        self.reactions.clear();
        self.drop_waiting();
    }

    /// The garment has changed: drops all data of the old one, and queues `Hello` and the next self-test.
    pub fn renew(&mut self) {
        self.flag(Report::HELLO);
        if self.streaming {
            self.flag(Report::SELF_TEST);
        }
        self.image.clear();
        self.drop_waiting();
    }

    /// Drops what was perceived. Ends of contacts and reactions stay, because nothing else would report them.
    fn drop_waiting(&mut self) {
        self.reflexes.clear();
        self.gestures.clear();
        (self.image.due, self.raw.due) = (None, None);
        self.latest.clear();
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
        self.queue_log(Level::Error, text);
    }

    pub fn queue_log(&mut self, level: Level, text: fmt::Arguments<'_>) {
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

    /// Queues once a second: `Hello` until `Start`, then `Health`.
    pub fn tick(&mut self, now: Micros) {
        if self.beat.due(now) {
            self.flag(if self.streaming { Report::HEALTH } else { Report::HELLO });
        }
    }

    /// Queues a time report, unless one is waiting.
    pub fn queue_budget(&mut self, budget: impl FnOnce() -> Option<Budget>) {
        if self.streaming && !self.latest.has(Report::BUDGET) {
            budget().iter().for_each(|budget| self.note(Report::BUDGET, budget));
        }
    }

    /// Queues a temperature, once a second.
    pub fn queue_temperature(&mut self, time: Micros, celsius: Option<Celsius>) {
        let Some(celsius) = celsius else { return };
        if self.streaming && self.warm.due(time) {
            self.note(Report::TEMPERATURE, &Temperature { time, celsius });
        }
    }

    /// Queues what was perceived in a frame. If the frame is `late`, its image, which is costly, is left out,
    /// unless one is already waiting for the link.
    pub fn enqueue(
        &mut self,
        frame: u32,
        time: Micros,
        percept: &Percept<'_>,
        late: bool,
        health: &mut Health,
    ) {
        if !self.streaming {
            return;
        }
        for reaction in percept.reactions.changes() {
            self.reaction(ReactionReport { frame, time, reaction: reaction.clone() }, health);
        }
        if let Some(meaning) = percept.meaning.filter(|_| self.rates.intent) {
            let report = intent_report((frame, time), meaning);
            if meaning.changed {
                health.lost += u32::from(self.changes.push_back(report).is_err());
                self.intent = None;
            } else {
                self.intent = Some(report);
            }
        }
        if let Some((gesture, name)) = &percept.gesture {
            let report = gesture_report((frame, time), gesture, name);
            health.lost += u32::from(self.gestures.push_back(report).is_err());
        }
        self.enqueue_contacts(frame, time, percept, health);
        self.enqueue_symbols(frame, time, percept, health);
        // A waiting image is encoded from the newest image and codes, so it gets their number.
        let due = self.rates.frames.due(time);
        let waits = self.image.due.is_some();
        health.thinned_frames += u32::from(due && (waits || late));
        if waits || (due && !late) {
            self.image.due = Some((frame, time));
        }
    }

    /// Queues the codes of a frame, if they are to be sent raw.
    pub fn enqueue_raw(&mut self, frame: u32, time: Micros, codes: &[Code]) {
        if cfg!(feature = "raw") && self.streaming {
            self.raw.take((frame, time), codes);
        }
    }

    /// Queues a reaction that began or ended.
    pub fn reaction(&mut self, report: ReactionReport, health: &mut Health) {
        if self.streaming {
            health.lost += u32::from(!self.reactions.push(report));
        }
    }

    /// Queues a reflex, and the reaction it began, unless a frame has shown its cause meanwhile.
    pub fn reflex(&mut self, report: ReflexReport, reaction: Option<Reaction>, health: &mut Health) {
        if !self.streaming {
            return;
        }
        let ReflexReport { frame, time, .. } = report;
        health.lost += u32::from(self.reflexes.push_back(report).is_err());
        if let Some(reaction) = reaction {
            self.reaction(ReactionReport { frame, time, reaction }, health);
        }
    }

    /// Queues the newest state of each contact; onsets and ends stay until they are sent.
    fn enqueue_contacts(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        let due = self.rates.contacts.due(time);
        let Percept { present, released, dropped, .. } = *percept;
        self.contacts.take((frame, time), [present, released], due && !present.is_empty(), health);
        self.contacts.dropped = dropped;
        self.contacts.waits |= percept.unsure.has_changed();
    }

    fn enqueue_symbols(&mut self, frame: u32, time: Micros, percept: &Percept<'_>, health: &mut Health) {
        if self.rates.symbols && (percept.symbols.has_events() || self.waits(Report::SYMBOLS)) {
            let Percept { symbols, present, released, .. } = *percept;
            self.list_regions((frame, time), symbols.regions(PANELS));
            self.list_events(symbols, [present, released], health);
        }
    }

    /// Queues the touched ones of these regions.
    fn list_regions(&mut self, (frame, time): (u32, Micros), regions: &[RegionState]) {
        if !self.waits(Report::SYMBOLS) {
            self.symbols.events.clear();
        }
        self.flag(Report::SYMBOLS);
        let list = &mut self.symbols;
        list.regions.clear();
        for region in regions.iter().filter(|region| region.contacts > 0) {
            // There are as many places as regions.
            let _ = list.regions.push(*region);
        }
        (list.frame, list.time) = (frame, time);
    }

    /// Adds the events of contacts that are present, and of those that ended.
    fn list_events(
        &mut self,
        symbols: &SymbolState<CONTACTS>,
        [present, released]: [&[Placed]; 2],
        health: &mut Health,
    ) {
        for event in symbols.events(present, released) {
            health.lost += u32::from(self.symbols.events.push(event).is_err());
        }
    }

    /// Queues the ends of contacts whose garment is no longer in use. They precede the `Hello` of the next one,
    /// whose panels and regions have other names.
    pub fn end_contacts(
        &mut self,
        at: (u32, Micros),
        released: &[Placed],
        symbols: &SymbolState<CONTACTS>,
        health: &mut Health,
    ) {
        let Streamed { contacts, symbols: has_symbols, .. } = self.streamed();
        if contacts {
            self.contacts.take(at, [&[], released], false, health);
            (self.contacts.waits, self.parting) = (true, true);
        }
        if has_symbols {
            self.list_regions(at, &[]);
            self.list_events(symbols, [&[], released], health);
        }
    }

    /// Queues that there is no intention: garment or scene have changed, and with them the map's inputs.
    pub fn end_intention(&mut self, at: (u32, Micros)) {
        self.changes.clear();
        self.intent = self.streamed().intent.then(|| intent_report(at, &Meaning::NONE));
    }

    /// Queues what is present of all that is streamed now and was not `before`, and that nothing is present
    /// of what no longer is streamed.
    #[inline(never)] // M0+: out of line
    pub fn queue_present(
        &mut self,
        before: Streamed,
        at: (u32, Micros),
        (present, regions, meaning): (&[Placed], &[RegionState], &Meaning),
        health: &mut Health,
    ) {
        let now = self.streamed();
        if before.contacts != now.contacts && (before.contacts || !present.is_empty()) {
            let present = if now.contacts { present } else { &[] };
            self.contacts.take(at, [present, &[]], false, health);
            self.contacts.waits = true;
        }
        if before.symbols != now.symbols && (before.symbols || !present.is_empty()) {
            self.list_regions(at, if now.symbols { regions } else { &[] });
        }
        if before.intent != now.intent && (before.intent || meaning.leading != Leading::None) {
            let meaning = if now.intent { meaning } else { &Meaning::NONE };
            self.intent = Some(intent_report(at, meaning));
        }
    }

    /// True if a report waits of which nothing but its flag is asked.
    fn waits(&self, number: u32) -> bool {
        self.flagged & only(number) != 0
    }

    /// All reports that wait here.
    fn due(&self) -> Reports {
        let queued = [
            (Report::SYNC, !self.synced.is_empty()),
            (Report::ANSWER, !self.answers.is_empty()),
            (Report::REFLEX, !self.reflexes.is_empty()),
            (Report::REACTION, !self.reactions.is_empty()),
            (Report::CONTACTS, self.contacts.waits),
            (Report::INTENT, self.intent.is_some() || !self.changes.is_empty()),
            (Report::GESTURE, !self.gestures.is_empty()),
            (Report::LOG, !self.logs.is_empty()),
            (Report::FRAME, self.image.due.is_some()),
            (Report::RAW, self.raw.due.is_some()),
        ];
        let of = |all, (number, waits): (u32, bool)| all | u32::from(waits) << number;
        queued.into_iter().fold(self.flagged | self.latest.due(), of)
    }

    /// Encodes the most urgent report, unless a message is in transmission. `elsewhere` are reports whose queue
    /// is not here, which `put` encodes.
    pub fn prepare(
        &mut self,
        now: Micros,
        about: &About<'_>,
        (elsewhere, put): (Reports, impl FnOnce(u32, &mut TxFrame) -> bool),
        health: &mut Health,
        platform: &mut (impl Probe + Checksum),
    ) {
        if self.has_rest() {
            return;
        }
        platform.begin(Stage::Encode);
        let mut due = self.due() | elsewhere;
        self.parting &= due & PARTING != 0;
        if self.parting {
            due &= !OF_GARMENT;
        }
        if !self.streaming {
            due &= !STREAMED;
        }
        if about.examined.is_none() {
            due &= !only(Report::SELF_TEST);
        }
        if due != 0 {
            let number = due.trailing_zeros();
            self.flagged &= !only(number);
            let fits = if elsewhere & only(number) != 0 {
                put(number, &mut self.tx_frame)
            } else {
                self.encode(number, now, about, health)
            };
            health.lost = health.lost.wrapping_add(u32::from(!fits));
        }
        self.tx_frame.close(platform);
        platform.begin(Stage::Idle);
    }

    /// Encodes a report that waits. Own frame: its buffers are on the stack only here.
    #[inline(never)]
    fn encode(&mut self, number: u32, now: Micros, about: &About<'_>, health: &mut Health) -> bool {
        let tx_frame = &mut self.tx_frame;
        match number {
            Report::HELLO => greeting::put(tx_frame, now, about),
            Report::SYNC => self.synced.pop_front().is_none_or(|(token, received)| {
                tx_frame.put(number, &SyncReport { token, received, sent: now })
            }),
            Report::SELF_TEST => about.examined.is_none_or(|report| tx_frame.put(number, report)),
            Report::ANSWER => self.answers.pop_front().is_none_or(|(request, refusal)| {
                let refusal = refusal.as_ref().map(|why| why.0.as_str());
                tx_frame.put(number, &Answer { request, refusal })
            }),
            Report::REFLEX => self.reflexes.pop_front().is_none_or(|report| tx_frame.put(number, &report)),
            Report::REACTION => self.reactions.pop().is_none_or(|report| tx_frame.put(number, &report)),
            Report::SHAPES => match about.taught.gallery() {
                Some(gallery) => tx_frame.put(number, &(gallery.prototypes.len() as u16, &gallery.names)),
                None => tx_frame.put(number, &(0u16, Vec::<Name, 0>::new())),
            },
            Report::CONTACTS => {
                self.contacts.waits = false;
                let ages = if self.rates.form_ages { about.form_ages } else { &[] };
                tx_frame.put(number, &List::of(&self.contacts, about.present, about.unsure, ages))
            }
            Report::SYMBOLS => tx_frame.put(number, &self.symbols),
            Report::INTENT => {
                // Encoded in place: it may have 64 concepts.
                let report = self.changes.front().or(self.intent.as_ref());
                let fits = report.is_none_or(|report| tx_frame.put(number, report));
                if self.changes.pop_front().is_none() {
                    self.intent = None;
                }
                fits
            }
            Report::GESTURE => self.gestures.pop_front().is_none_or(|report| tx_frame.put(number, &report)),
            Report::LOG => self
                .logs
                .pop_front()
                .is_none_or(|(level, text)| tx_frame.put(number, &Log { time: now, level, text: &text })),
            Report::HEALTH_MAP => {
                let taxels = about.setup.layout.taxels() as u16;
                let map = health_map::part(now, self.map, taxels, about.monitor.faulty());
                self.map = map.end;
                if map.end < taxels {
                    self.flagged |= only(number);
                }
                tx_frame.put(number, &map)
            }
            Report::HEALTH => tx_frame.put(number, &Health { time: now, ..*health }),
            Report::FRAME => self.image.put(tx_frame, about, self.rates.key_us, health),
            Report::RAW => self.raw.put(tx_frame),
            _ => self.latest.take(number).is_none_or(|body| tx_frame.put(number, &body)),
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

fn intent_report((frame, time): (u32, Micros), meaning: &Meaning) -> IntentReport {
    let Meaning { leading, outcome, steps, ref activations, .. } = *meaning;
    IntentReport { frame, time, leading, outcome, steps, concepts: activations.clone() }
}

fn gesture_report((frame, time): (u32, Micros), gesture: &Gesture, name: &Name) -> GestureReport {
    let Gesture { touch, panel, class, score, lead, confidence, observed_ms, ended } = *gesture;
    let name = name.clone();
    GestureReport { frame, time, touch, panel, class, name, score, lead, observed_ms, ended, confidence }
}
