//! Remembers settings that last until the board restarts, so that they can be restored.

use super::{BoardDescription, cleaned};
use crate::time::Instant;
use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;
use taxel_core::condition::Certificate;
use taxel_core::format::Name;
use taxel_core::garment::Garment;
use taxel_core::intent::Feed;
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, decode, encode, frame_bound};

/// A calibration, for the number of its request.
const UNNAMED: Certificate = Certificate { id: 0, taxels: 0, year: 0, month: 0, day: 0, error: 0 };
/// Most requests awaiting answers: a board queues eight answers and drops further ones.
const WINDOW: usize = 4;
/// Most unanswered requests remembered; beyond that, the oldest is assumed to be done.
const OPEN: usize = 4096;

/// Setting of a request, in the order of restoring: the garment first, because it resets the gains; the start before
/// the tare, whose answer takes a while.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Garment,
    Scene,
    /// From this taxel on.
    Gain(u16),
    Calibration,
    /// Head of a base, and each of its parts.
    Shapes(usize),
    /// A piece of a table, which the board keeps.
    Table,
    /// Feed of this concept.
    Feed(Name),
    Start,
    /// Streams beside the scene.
    Stream,
    Tare,
}

/// A remembered request.
#[derive(Debug, Clone)]
struct Setting {
    number: u8,
    /// The request as a frame of the wire.
    frame: Vec<u8>,
    /// A feed, which ages, and when it was sent.
    feed: Option<(Feed, Instant)>,
    /// True if it only undoes an earlier setting; nothing is to be restored.
    clears: bool,
    /// Encoded garment or scene.
    body: Vec<u8>,
}

/// A request that sets something.
#[derive(Debug, Clone)]
pub(super) struct Sets(Key, Setting);

/// A request to be repeated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct WantedSetting {
    /// Request number.
    pub number: u8,
    /// The request as a frame of the wire.
    pub frame: Vec<u8>,
}

/// The remembered settings.
#[derive(Debug, Default, Clone)]
pub(super) struct Wanted {
    /// Settings that the board has confirmed.
    done: BTreeMap<Key, Setting>,
    /// Unanswered settings in order, and when they were sent.
    asked: VecDeque<(Key, Setting, Instant)>,
}

impl Wanted {
    /// Remembers a request that is being sent.
    pub fn ask(&mut self, Sets(key, setting): Sets) {
        self.asked.push_back((key, setting, Instant::now()));
        if self.asked.len() > OPEN
            && let Some((key, setting, _)) = self.asked.pop_front()
        {
            self.put(key, setting);
        }
    }

    /// True if another request may be sent: what follows a piece of a table waits for its answer.
    pub(crate) fn takes_more(&self) -> bool {
        self.asked.len() < WINDOW && !self.awaits_piece()
    }

    /// True if a piece of a table is not answered yet.
    pub(crate) fn awaits_piece(&self) -> bool {
        self.asked.iter().any(|(key, ..)| *key == Key::Table)
    }

    /// True if a board with this `Hello` may still have its settings.
    pub fn agrees(&self, description: &BoardDescription) -> bool {
        let body = |key| self.done.get(&key).map(|setting| setting.body.as_slice());
        let garment = body(Key::Garment).and_then(garment);
        let scene = body(Key::Scene).and_then(|bytes| decode::<Scene>(bytes).ok()).map(|mut scene| {
            cleaned::scene(&mut scene);
            scene
        });
        garment.is_none_or(|garment| garment == description.garment)
            && scene.is_none_or(|scene| scene == description.scene)
    }

    /// The scene requested last, unless the board has answered that.
    pub(crate) fn asked_scene(&self) -> Option<Scene> {
        let (_, setting, _) = self.asked.iter().rfind(|(key, ..)| *key == Key::Scene)?;
        decode(&setting.body).ok()
    }

    /// Handles the answer to the request with this number; a refused setting is forgotten.
    pub fn answered(&mut self, number: u8, is_done: bool) {
        let at = self.asked.iter().position(|(_, setting, _)| setting.number == number);
        let Some((key, setting, _)) = at.and_then(|at| self.asked.remove(at)) else { return };
        if is_done {
            self.put(key, setting);
        }
    }

    /// Remembers a confirmed setting; forgets the settings that it undoes.
    fn put(&mut self, key: Key, setting: Setting) {
        let key = match key {
            Key::Garment => {
                self.done.retain(|key, _| !matches!(key, Key::Gain(_) | Key::Calibration | Key::Tare));
                key
            }
            Key::Gain(_) => {
                self.done.remove(&Key::Calibration);
                key
            }
            Key::Shapes(0) => {
                self.done.retain(|key, _| !matches!(key, Key::Shapes(_)));
                key
            }
            Key::Shapes(_) => {
                Key::Shapes(self.done.keys().filter(|key| matches!(key, Key::Shapes(_))).count())
            }
            key => key,
        };
        if setting.clears {
            self.done.remove(&key);
        } else {
            self.done.insert(key, setting);
        }
    }

    /// True if a request has waited this long for its answer. A tare takes its time.
    pub(crate) fn is_overdue(&self, patience: Duration) -> bool {
        self.asked.iter().any(|(key, _, since)| *key != Key::Tare && since.elapsed() > patience)
    }

    /// Requests that restore everything, in order; unanswered ones are included.
    pub fn all(&mut self) -> VecDeque<WantedSetting> {
        self.settle();
        let start = encoded(&Request::Start).map(|frame| (Key::Start, frame));
        let start = start.map(|(key, frame)| (key, WantedSetting { number: Request::Start.number(), frame }));
        let mut all: BTreeMap<Key, WantedSetting> =
            self.done.iter().map(|(key, setting)| (key.clone(), setting.setting())).collect();
        all.extend(start);
        all.into_values().collect()
    }

    /// Requests for a board that has probably kept its settings: unanswered ones, and those that its `Hello`
    /// does not prove, but no tare.
    pub fn unproven(&mut self) -> VecDeque<WantedSetting> {
        let open: Vec<u8> = self.asked.iter().map(|(_, setting, _)| setting.number).collect();
        let proven = [
            Request::SetGarment(&[]).number(),
            Request::SetScene(&[]).number(),
            Request::Tare { frames: 0 }.number(),
            Request::SetGain { first: 0, gains: Default::default() }.number(),
            Request::SetCalibration(UNNAMED).number(),
        ];
        let mut all = self.all();
        all.retain(|setting| open.contains(&setting.number) || !proven.contains(&setting.number));
        all
    }

    /// Counts everything as confirmed, because it will be sent again.
    fn settle(&mut self) {
        while let Some((key, setting, _)) = self.asked.pop_front() {
            self.put(key, setting);
        }
    }
}

impl Sets {
    /// Setting of a request in its frame of the wire; none if it sets nothing that lasts.
    pub fn of(request: &Request<'_>, frame: &[u8]) -> Option<Sets> {
        let (key, clears) = match request {
            Request::SetGarment(_) => (Key::Garment, false),
            Request::SetScene(_) => (Key::Scene, false),
            Request::SetGain { first, .. } => (Key::Gain(*first), false),
            Request::SetCalibration(_) => (Key::Calibration, false),
            Request::SetShapes(bytes) => (Key::Shapes(0), bytes.is_empty()),
            // Its position among the parts is known once it is confirmed.
            Request::AddShapes(_) => (Key::Shapes(1), false),
            Request::SetTable(_) => (Key::Table, true),
            Request::Stream { .. } => (Key::Stream, false),
            Request::Feed(feed) => (Key::Feed(feed.concept.clone()), false),
            Request::Tare { .. } => (Key::Tare, false),
            // These have no lasting effect; a posture is sent again by whoever measures it.
            _ => return None,
        };
        let feed =
            if let Request::Feed(feed) = request { Some((feed.clone(), Instant::now())) } else { None };
        let body = match request {
            Request::SetGarment(bytes) | Request::SetScene(bytes) => bytes.to_vec(),
            _ => Vec::new(),
        };
        Some(Sets(key, Setting { number: request.number(), frame: frame.to_vec(), feed, clears, body }))
    }

    /// True for a garment.
    pub(crate) fn is_garment(&self) -> bool {
        self.0 == Key::Garment
    }

    /// The garment that it sets, as a `Hello` reports it; none if it sets something else.
    pub fn garment(&self) -> Option<Garment> {
        garment(&self.1.body).filter(|_| self.is_garment())
    }

    /// True for a piece of a table.
    pub(crate) fn is_piece(&self) -> bool {
        self.0 == Key::Table
    }
}

impl Setting {
    fn setting(&self) -> WantedSetting {
        let older = self.feed.as_ref().and_then(|(feed, reported)| {
            let passed = u32::try_from(reported.elapsed().as_millis()).unwrap_or(u32::MAX);
            let age_ms = feed.age_ms.saturating_add(passed);
            encoded(&Request::Feed(Feed { age_ms, ..feed.clone() }))
        });
        WantedSetting { number: self.number, frame: older.unwrap_or_else(|| self.frame.clone()) }
    }
}

/// Decodes a garment, as a `Hello` reports it.
fn garment(bytes: &[u8]) -> Option<Garment> {
    let mut garment = decode(bytes).ok()?;
    cleaned::garment(&mut garment);
    Some(garment)
}

/// Encodes a request as a frame of the wire; none if it is too long.
fn encoded(request: &Request<'_>) -> Option<Vec<u8>> {
    let mut room = [0; frame_bound(LONGEST_REQUEST)];
    encode(request, &mut room).ok().map(|frame| frame.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::format::{Q15, name};
    use taxel_core::wire::open;

    fn ask(wanted: &mut Wanted, request: &Request<'_>) {
        let frame = encoded(request).unwrap();
        wanted.ask(Sets::of(request, &frame).unwrap());
    }

    fn numbers(wanted: &mut Wanted) -> Vec<u8> {
        wanted.all().iter().map(|setting| setting.number).collect()
    }

    #[test]
    fn a_value_grows_older_while_it_waits() {
        let mut wanted = Wanted::default();
        let feed =
            Feed { concept: name("warmth"), value: Q15(1), age_ms: 70, timeout_ms: 900, default: Q15(2) };
        ask(&mut wanted, &Request::Feed(feed.clone()));
        crate::time::sleep(Duration::from_millis(20));
        let mut frame = wanted.all().pop_front().unwrap().frame;
        frame.pop();
        let Request::Feed(reported) = decode::<Request<'_>>(open(&mut frame).unwrap()).unwrap() else {
            panic!()
        };
        assert!((90..5000).contains(&reported.age_ms), "{}", reported.age_ms);
        assert_eq!(Feed { age_ms: 70, ..reported }, feed);
    }

    #[test]
    fn what_is_refused_undone_or_replaced_is_not_asked_for_again() {
        let mut wanted = Wanted::default();
        let start = Request::Start.number();
        assert_eq!(numbers(&mut wanted), [start]);
        for request in [
            Request::SetGain { first: 64, gains: Default::default() },
            Request::SetGain { first: 0, gains: Default::default() },
            Request::Tare { frames: 9 },
            Request::SetShapes(&[1]),
            Request::AddShapes(&[2]),
            Request::AddShapes(&[3]),
            Request::Stream { raw_hz: 3, budget_hz: 1 },
        ] {
            ask(&mut wanted, &request);
            wanted.answered(request.number(), true);
        }
        assert_eq!(numbers(&mut wanted), [10, 10, 8, 9, 9, start, 4, 12]);
        for (request, is_done) in [
            (Request::SetScene(&[9]), false),
            (Request::Stream { raw_hz: 0, budget_hz: 1 }, true),
            (Request::SetShapes(&[]), true),
            (Request::SetGarment(&[9]), true),
        ] {
            ask(&mut wanted, &request);
            wanted.answered(request.number(), is_done);
        }
        assert_eq!(numbers(&mut wanted), [5, start, 4], "a garment undoes gains and tare");
        // Unanswered requests count as sent.
        ask(&mut wanted, &Request::SetScene(&[7]));
        let unproven =
            |wanted: &mut Wanted| wanted.unproven().iter().map(|setting| setting.number).collect::<Vec<_>>();
        assert_eq!(unproven(&mut wanted), [6, start, 4]);
        assert_eq!(unproven(&mut wanted), [start, 4]);
    }
}
