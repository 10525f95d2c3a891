//! What waits to be sent, in the order of its urgency; encoded only when the link has room.

use super::pace::Rates;
use super::setup::{BoardInfo, Setup};
use super::{Codes, Sentence};
use crate::contact::Phase;
use crate::format::{Code, Micros};
use crate::pipeline::{Percept, Probe, Stage};
use crate::scene::StreamConfig;
use crate::symbol::{EVENTS, RegionState, Symbol};
use crate::wire::*;
use core::fmt::{self, Write};
use heapless::{Deque, Vec};
use serde::Serialize;

/// Room for an image: any of 2,048 taxels.
const IMAGE: usize = image_bound(2048, 16);
/// Longest body of a message: an image and what stands before it. A full list of contacts is shorter.
const BODY: usize = IMAGE + 64;
/// Its frame.
const FRAME: usize = frame_bound(BODY);

/// Why something is refused, as a sentence.
#[derive(Debug, Clone)]
pub(super) struct Refusal(Sentence);

impl Refusal {
    /// The sentence of an error.
    pub fn of(error: impl fmt::Display) -> Refusal {
        format_args!("{error}").into()
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
    seq: u32,
    body: [u8; BODY],
    wire: [u8; FRAME],
    from: usize,
    to: usize,
    streaming: bool,
    hello: Option<Micros>,
    synced: Deque<(u32, Micros), 4>,
    answers: Deque<(u8, Option<Refusal>), 8>,
    logs: Deque<Sentence, 4>,
    reactions: Deque<ReactionReport, 16>,
    changes: Deque<IntentReport, 8>,
    intent: Option<IntentReport>,
    events: Vec<Symbol, EVENTS>,
    symbols: Option<(u32, Micros, Vec<RegionState, { crate::garment::PANELS }>)>,
    contacts: ContactList,
    contacts_wait: bool,
    health: Option<Micros>,
    image: Image<TAXELS>,
    raw: Option<(u32, Micros)>,
    codes: Codes<TAXELS>,
    rates: Rates,
}

/// The image that waits, and the one that was sent last.
struct Image<const TAXELS: usize> {
    due: Option<(u32, Micros)>,
    base: Option<u32>,
    key: Micros,
    last: [u16; TAXELS],
}

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Nothing waits yet.
    #[inline(never)]
    pub fn new(stream: &StreamConfig) -> Self {
        Outbox {
            seq: 0,
            body: [0; BODY],
            wire: [0; FRAME],
            from: 0,
            // One 0x00 first: whatever a booting board or an opening line put on the wire ends there.
            to: 1,
            streaming: false,
            hello: Some(Micros(0)),
            synced: Deque::new(),
            answers: Deque::new(),
            logs: Deque::new(),
            reactions: Deque::new(),
            changes: Deque::new(),
            intent: None,
            events: Vec::new(),
            symbols: None,
            contacts: ContactList { frame: 0, time: Micros(0), dropped: 0, contacts: Vec::new() },
            contacts_wait: false,
            health: None,
            image: Image { due: None, base: None, key: Micros(0), last: [0; TAXELS] },
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
        self.forget_image();
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
        self.drop_waiting();
    }

    fn drop_waiting(&mut self) {
        self.reactions.clear();
        self.changes.clear();
        (self.intent, self.symbols, self.image.due, self.raw) = (None, None, None, None);
        self.events.clear();
        self.contacts.contacts.clear();
        self.contacts_wait = false;
    }

    /// The next image stands alone.
    pub fn forget_image(&mut self) {
        self.image.base = None;
    }

    pub fn answer(&mut self, request: u8, refusal: Option<Refusal>) {
        // A host that asks eight times without reading gets no ninth answer.
        let _ = self.answers.push_back((request, refusal));
    }

    pub fn log(&mut self, text: fmt::Arguments<'_>) {
        let _ = self.logs.push_back(Refusal::from(text).0);
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
        let untold: Vec<u32, LISTED> =
            list.iter().filter(|p| p.contact.phase == Phase::Onset).map(|p| p.contact.id).collect();
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
        if !self.rates.symbols || (events.is_empty() && self.symbols.is_none()) {
            return;
        }
        for event in events {
            health.lost += u32::from(self.events.push(*event).is_err());
        }
        let all = percept.symbols.regions(crate::garment::PANELS);
        let touched = all.iter().filter(|region| region.contacts > 0).copied().collect();
        self.symbols = Some((frame, time, touched));
    }

    /// Keeps the codes of a frame that is to be sent raw.
    pub fn raw(&mut self, codes: &[Code], taxels: usize) {
        if self.raw.is_some() {
            self.codes.clear();
            let _ = self.codes.extend_from_slice(codes.get(..taxels).unwrap_or(codes));
        }
    }

    /// What is to be sent next.
    pub fn pending(
        &mut self,
        now: Micros,
        info: &BoardInfo,
        setup: &Setup,
        image: &[u16],
        health: &mut Health,
        probe: &mut impl Probe,
    ) -> &[u8] {
        if self.from >= self.to {
            probe.begin(Stage::Encode);
            (self.from, self.to) = (0, 0);
            self.next(now, info, setup, image, health);
            probe.begin(Stage::Idle);
        }
        self.wire.get(self.from..self.to).unwrap_or(&[])
    }

    pub fn sent(&mut self, count: usize) {
        self.from = self.from.saturating_add(count).min(self.to);
    }

    /// Encodes the most urgent message, if there is one. Its buffers are on the stack only meanwhile.
    #[inline(never)]
    fn next(&mut self, now: Micros, info: &BoardInfo, setup: &Setup, image: &[u16], health: &mut Health) {
        if let Some((token, received)) = self.synced.pop_front() {
            self.put(&Report::Sync(SyncReport { token, received, sent: now }), health);
        } else if self.hello.is_some_and(|due| due <= now) {
            self.hello = None;
            self.put_hello(now, info, setup, health);
        } else if let Some((request, refusal)) = self.answers.pop_front() {
            let refusal = refusal.as_ref().map(|why| why.0.as_str());
            self.put(&Report::Answer(Answer { request, refusal }), health);
        } else if let Some(report) = self.reactions.pop_front() {
            self.put(&Report::Reaction(report), health);
        } else if self.contacts_wait {
            self.contacts_wait = false;
            let contacts = self.contacts.clone();
            self.put(&Report::Contacts(contacts), health);
        } else if let Some((frame, time, regions)) = self.symbols.take() {
            let events = core::mem::take(&mut self.events);
            self.put(&Report::Symbols(SymbolList { frame, time, events, regions }), health);
        } else if let Some(report) = self.changes.pop_front().or_else(|| self.intent.take()) {
            self.put(&Report::Intent(report), health);
        } else if let Some(text) = self.logs.pop_front() {
            self.put(&Report::Log(Log { time: now, level: Level::Error, text: &text }), health);
        } else if self.health.is_some_and(|due| due <= now) {
            self.health = None;
            let report = Report::Health(Health { time: now, ..*health });
            self.put(&report, health);
        } else if let Some((frame, time)) = self.image.due.take() {
            self.put_image(frame, time, image, health);
        } else if let Some((frame, time)) = self.raw.take() {
            self.put_raw(frame, time, health);
        }
    }

    fn put(&mut self, report: &Report<'_>, health: &mut Health) -> bool {
        let Outbox { seq, body, wire, to, .. } = self;
        put(seq, body, wire, to, report, health)
    }

    fn put_hello(&mut self, now: Micros, info: &BoardInfo, setup: &Setup, health: &mut Health) {
        let (mut clock, mut garment, mut scene) = ([0; 10], [0; 2048], [0; 2048]);
        let hello = Report::Hello(Hello {
            magic: MAGIC,
            protocol: PROTOCOL,
            garment: written(&setup.garment, &mut garment),
            firmware: info.firmware.as_bytes(),
            clock: written(&now, &mut clock),
            scene: written(&setup.scene, &mut scene),
            calibration: &[],
        });
        self.put(&hello, health);
    }

    fn put_image(&mut self, frame: u32, time: Micros, image: &[u16], health: &mut Health) {
        let Outbox { seq, body, wire, to, image: Image { base, key, last, .. }, rates, .. } = self;
        let fresh = time.since(*key) >= rates.key_us;
        let against = base.filter(|_| !fresh);
        let mut data = [0; IMAGE];
        let reference = last.get(..image.len()).filter(|_| against.is_some());
        let Some(length) = encode_image(image, reference, &mut data) else {
            health.thinned_frames += 1;
            return;
        };
        let sum = image_sum(image);
        let data = data.get(..length).unwrap_or(&[]);
        let report = Report::Frame(Frame { frame, time, base: against, sum, data });
        if put(seq, body, wire, to, &report, health) {
            if against.is_none() {
                *key = time;
            }
            *base = Some(frame);
            for (kept, value) in last.iter_mut().zip(image) {
                *kept = *value;
            }
        }
    }

    fn put_raw(&mut self, frame: u32, time: Micros, health: &mut Health) {
        let Outbox { seq, body, wire, to, codes, .. } = self;
        let mut data = [0; IMAGE];
        let mut plain = [0; TAXELS];
        for (value, code) in plain.iter_mut().zip(codes.iter()) {
            *value = code.0;
        }
        let plain = plain.get(..codes.len()).unwrap_or(&[]);
        let Some(data) = encode_image(plain, None, &mut data).and_then(|length| data.get(..length)) else {
            health.lost = health.lost.wrapping_add(1);
            return;
        };
        put(seq, body, wire, to, &Report::Raw(Raw { frame, time, data }), health);
    }
}

/// Encodes a message into the frame that is sent next; `seq` counts only what was encoded.
fn put(
    seq: &mut u32,
    body: &mut [u8; BODY],
    wire: &mut [u8; FRAME],
    to: &mut usize,
    report: &Report<'_>,
    health: &mut Health,
) -> bool {
    match encode(&(*seq, report), body, wire) {
        Ok(length) => {
            *seq = seq.wrapping_add(1);
            *to = length;
            true
        }
        Err(_) => {
            health.lost = health.lost.wrapping_add(1);
            false
        }
    }
}

/// postcard of a value; nothing where it does not fit.
fn written<'a, T: Serialize>(value: &T, buffer: &'a mut [u8]) -> &'a [u8] {
    match postcard::to_slice(value, buffer) {
        Ok(bytes) => bytes,
        Err(_) => &[],
    }
}
