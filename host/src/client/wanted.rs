//! What was asked of a board that lasts until it restarts: a board that has started anew is asked for it again.

use super::{Worn, cleaned};
use std::collections::{BTreeMap, VecDeque};
use std::time::{Duration, Instant};
use taxel_core::format::Name;
use taxel_core::garment::Garment;
use taxel_core::intent::Feed;
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, decode, encode, frame_bound};

/// Number of `SetCalibration`.
const CALIBRATION: u8 = 15;
/// Requests without an answer that are remembered at most; of more, the board is taken to have done the oldest.
const OPEN: usize = 4096;

/// What a request sets, in the order in which everything is set again: the garment first, because it undoes the
/// gains; the start before the tare, whose answer takes a while.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Garment,
    Scene,
    /// From this taxel on.
    Gain(u16),
    Calibration,
    /// The head of a base, and each part that follows it.
    Shapes(usize),
    Certainty,
    Gestures,
    Forms,
    Raw,
    /// Of a slot.
    Concept(u8),
    /// Of a concept.
    Feed(Name),
    Start,
    Tare,
    Budget,
}

/// A request that is remembered.
#[derive(Debug, Clone)]
struct Setting {
    number: u8,
    /// In its frame of the wire.
    frame: Vec<u8>,
    /// A value that grows old, and when it was told.
    feed: Option<(Feed, Instant)>,
    /// It takes back what was set before, and leaves nothing to be set again.
    clears: bool,
    /// The garment or the scene as it is sent.
    body: Vec<u8>,
}

/// A request that sets something.
#[derive(Debug, Clone)]
pub(super) struct Sets(Key, Setting);

/// A request that is to be made again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wish {
    /// Number of its variant.
    pub number: u8,
    /// In its frame of the wire.
    pub frame: Vec<u8>,
}

/// What is remembered.
#[derive(Debug, Default, Clone)]
pub(super) struct Wanted {
    /// What the board has done.
    done: BTreeMap<Key, Setting>,
    /// What it has not answered yet, in the order in which it was asked, and since when.
    asked: VecDeque<(Key, Setting, Instant)>,
}

impl Wanted {
    /// A request that sets something is on its way.
    pub fn ask(&mut self, Sets(key, setting): Sets) {
        self.asked.push_back((key, setting, Instant::now()));
        if self.asked.len() > OPEN
            && let Some((key, setting, _)) = self.asked.pop_front()
        {
            self.put(key, setting);
        }
    }

    /// Requests that wait for their answers.
    pub fn asked(&self) -> usize {
        self.asked.len()
    }

    /// Whether a board that says this of itself can have kept what it was told.
    pub fn agrees(&self, worn: &Worn) -> bool {
        let body = |key| self.done.get(&key).map(|setting| setting.body.as_slice());
        let garment =
            body(Key::Garment).and_then(|bytes| decode::<Garment>(bytes).ok()).map(|mut garment| {
                cleaned::garment(&mut garment);
                garment
            });
        let scene = body(Key::Scene).and_then(|bytes| decode::<Scene>(bytes).ok()).map(|mut scene| {
            cleaned::scene(&mut scene);
            scene
        });
        garment.is_none_or(|garment| garment == worn.garment) && scene.is_none_or(|scene| scene == worn.scene)
    }

    /// The board has answered a request of this number: what it refuses is not remembered.
    pub fn answered(&mut self, number: u8, is_done: bool) {
        let at = self.asked.iter().position(|(_, setting, _)| setting.number == number);
        let Some((key, setting, _)) = at.and_then(|at| self.asked.remove(at)) else { return };
        if is_done {
            self.put(key, setting);
        }
    }

    /// The board has done this: what it undoes by it is forgotten.
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

    /// Whether a request has waited that long for its answer. A tare takes its time.
    pub fn is_overdue(&self, patience: Duration) -> bool {
        self.asked.iter().any(|(key, _, since)| *key != Key::Tare && since.elapsed() > patience)
    }

    /// What a board is to be asked for that knows nothing, in order; what it has not answered counts as asked
    /// for anew.
    pub fn all(&mut self) -> VecDeque<Wish> {
        self.settle();
        let start = encoded(&Request::Start).map(|frame| (Key::Start, frame));
        let start = start.map(|(key, frame)| (key, Wish { number: Request::Start.number(), frame }));
        let mut all: BTreeMap<Key, Wish> =
            self.done.iter().map(|(key, setting)| (key.clone(), setting.wish())).collect();
        all.extend(start);
        all.into_values().collect()
    }

    /// What a board is to be asked for that seems to have lived on: what it has not answered, and what its
    /// `Hello` does not prove, but no tare.
    pub fn unproven(&mut self) -> VecDeque<Wish> {
        let open: Vec<u8> = self.asked.iter().map(|(_, setting, _)| setting.number).collect();
        let proven = [
            Request::SetGarment(&[]).number(),
            Request::SetScene(&[]).number(),
            Request::Tare { frames: 0 }.number(),
            Request::SetGain { first: 0, gains: Default::default() }.number(),
            CALIBRATION,
        ];
        let mut all = self.all();
        all.retain(|wish| open.contains(&wish.number) || !proven.contains(&wish.number));
        all
    }

    /// Takes everything for done: it is asked for once more, one after the other.
    fn settle(&mut self) {
        while let Some((key, setting, _)) = self.asked.pop_front() {
            self.put(key, setting);
        }
    }
}

impl Sets {
    /// Of a request in its frame of the wire; none: it sets nothing that lasts.
    pub fn of(request: &Request<'_>, frame: &[u8]) -> Option<Sets> {
        let (key, clears) = match request {
            Request::SetGarment(_) => (Key::Garment, false),
            Request::SetScene(_) => (Key::Scene, false),
            Request::SetGain { first, .. } => (Key::Gain(*first), false),
            Request::SetCalibration(_) => (Key::Calibration, false),
            Request::SetShapes(bytes) => (Key::Shapes(0), bytes.is_empty()),
            // Its place among the parts is found when it is done.
            Request::AddShapes(_) => (Key::Shapes(1), false),
            Request::SetCertainty(_) => (Key::Certainty, false),
            Request::SetGestures(config) => (Key::Gestures, config.is_none()),
            Request::SetForms { .. } => (Key::Forms, false),
            Request::SetRaw { hz } => (Key::Raw, *hz == 0),
            Request::Concept { slot, .. } => (Key::Concept(*slot), false),
            Request::Feed(feed) => (Key::Feed(feed.concept.clone()), false),
            Request::Tare { .. } => (Key::Tare, false),
            Request::Budget { .. } => (Key::Budget, false),
            // What lasts no longer than its answer; a posture is told again by whoever measures it.
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
}

impl Setting {
    fn wish(&self) -> Wish {
        let older = self.feed.as_ref().and_then(|(feed, told)| {
            let passed = u32::try_from(told.elapsed().as_millis()).unwrap_or(u32::MAX);
            let age_ms = feed.age_ms.saturating_add(passed);
            encoded(&Request::Feed(Feed { age_ms, ..feed.clone() }))
        });
        Wish { number: self.number, frame: older.unwrap_or_else(|| self.frame.clone()) }
    }
}

/// A request in its frame of the wire; none: it is too long.
fn encoded(request: &Request<'_>) -> Option<Vec<u8>> {
    let mut room = [0; frame_bound(LONGEST_REQUEST)];
    encode(request, &mut room).ok().map(|frame| frame.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::format::{Q15, name};
    use taxel_core::gesture::GestureConfig;
    use taxel_core::wire::open;

    fn ask(wanted: &mut Wanted, request: &Request<'_>) {
        let frame = encoded(request).unwrap();
        wanted.ask(Sets::of(request, &frame).unwrap());
    }

    fn numbers(wanted: &mut Wanted) -> Vec<u8> {
        wanted.all().iter().map(|wish| wish.number).collect()
    }

    #[test]
    fn a_value_grows_older_while_it_waits() {
        let mut wanted = Wanted::default();
        let feed =
            Feed { concept: name("warmth"), value: Q15(1), age_ms: 70, lasts_ms: 900, otherwise: Q15(2) };
        ask(&mut wanted, &Request::Feed(feed.clone()));
        std::thread::sleep(Duration::from_millis(20));
        let mut frame = wanted.all().pop_front().unwrap().frame;
        frame.pop();
        let Request::Feed(told) = decode::<Request<'_>>(open(&mut frame).unwrap()).unwrap() else { panic!() };
        assert!((90..5000).contains(&told.age_ms), "{}", told.age_ms);
        assert_eq!(Feed { age_ms: 70, ..told }, feed);
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
            Request::SetGestures(Some(GestureConfig::default())),
        ] {
            ask(&mut wanted, &request);
            wanted.answered(request.number(), true);
        }
        assert_eq!(numbers(&mut wanted), [11, 11, 16, 17, 17, 14, start, 2]);
        for (request, is_done) in [
            (Request::SetScene(&[9]), false),
            (Request::SetGestures(None), true),
            (Request::SetShapes(&[]), true),
            (Request::SetGarment(&[9]), true),
        ] {
            ask(&mut wanted, &request);
            wanted.answered(request.number(), is_done);
        }
        assert_eq!(numbers(&mut wanted), [0, start], "a garment undoes gains and tare");
        // What the board has not answered counts as asked for.
        ask(&mut wanted, &Request::SetScene(&[7]));
        ask(&mut wanted, &Request::Budget { hz: 3 });
        assert_eq!(wanted.unproven().iter().map(|wish| wish.number).collect::<Vec<_>>(), [1, start, 12]);
        assert_eq!(wanted.unproven().iter().map(|wish| wish.number).collect::<Vec<_>>(), [start, 12]);
    }
}
