//! Outputs that can be relied on: whatever is asked, whatever fails, whatever touches, no pin is at rest
//! while its cause holds, and every begin and end is reported. The judge is a board of its own: it knows what
//! was done, when, and what was reported.

mod present;

use crate::board::{BoardAndHost, FINGER};
use std::collections::BTreeMap;
use taxel_core::acquire::ScanError;
use taxel_core::board::{Input, Job, Saved};
use taxel_core::format::{Micros, name};
use taxel_core::garment::{Garment, Line};
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::wire::{Report, Request};

const BLIND_MS: u64 = 30;
const SILENT_MS: u64 = 120;
const HOLD_MS: u32 = 10;
/// Frames after which the filter has let a press through, and a release.
const SETTLED: u32 = 4;

fn row(text: &str, cause: Cause, level: i32, (pin, inverted): (u8, bool)) -> ReactionConfig {
    let (region, output) = (name(""), Some(Line { pin, inverted }));
    ReactionConfig { name: name(text), cause, region, level, hysteresis: 0, hold_ms: HOLD_MS, output }
}

/// An enable that three causes share, a line for a silent host, a sign of life, and a touch of its own.
fn scene() -> Scene {
    let mut scene = Scene::shipped();
    scene.react.clear();
    let rows = [
        row("guard", Cause::Pressure, 300, (18, false)),
        row("guard blind", Cause::Blind, BLIND_MS as i32, (18, false)),
        row("guard fault", Cause::Fault, 1, (18, false)),
        row("lonely", Cause::Silent, SILENT_MS as i32, (20, true)),
        row("beat", Cause::Watching, 1, (24, false)),
        row("squeeze", Cause::Force, 2_000, (25, false)),
    ];
    scene.react.extend(rows);
    scene
}

/// What was done, and what should follow.
struct Judge {
    bench: BoardAndHost,
    scene: Scene,
    random: fastrand::Rng,
    pins: BTreeMap<u8, bool>,
    /// Names of the reactions that were reported as lasting.
    reported: Vec<String>,
    /// When a frame was perceived last.
    seen: Option<u64>,
    heard: u64,
    failed: bool,
    faults: usize,
    /// Those that the next self-test finds.
    broken: usize,
    /// Frames that a tare still takes.
    taring: u32,
    /// Something pressed or left meanwhile: what it takes for rest is none.
    spoiled: bool,
    tared: bool,
    pressed: bool,
    /// Good frames since the press or the release.
    settled: u32,
    /// Level of the sign of life.
    beat: bool,
    /// What was done last.
    doing: String,
}

impl Judge {
    fn new(seed: u64) -> Judge {
        let mut judge = Judge {
            bench: BoardAndHost::new(scene()),
            scene: scene(),
            random: fastrand::Rng::with_seed(seed),
            pins: BTreeMap::new(),
            reported: Vec::new(),
            seen: None,
            heard: 0,
            failed: false,
            faults: 0,
            broken: 0,
            taring: 0,
            spoiled: false,
            tared: false,
            pressed: false,
            settled: 0,
            beat: false,
            doing: "start".into(),
        };
        judge.ask(&Request::Start);
        judge
    }

    fn ask(&mut self, request: &Request<'_>) {
        self.bench.ask(request);
        self.heard = self.bench.now;
    }

    /// The board's loop until it wants to scan: pins follow, works are done.
    fn settle(&mut self) {
        for _ in 0..100 {
            match self.bench.tick() {
                Some(Job::Drive(pin, level)) => _ = self.pins.insert(pin, level),
                Some(Job::Save) => {
                    assert!(self.pins[&18], "{}: a save begins, and nobody was warned", self.doing);
                    self.seen = None;
                    self.bench.now += 200_000;
                    self.give(Input::Saved(Ok(Saved::Written)));
                }
                Some(Job::Examine) => self.examine(),
                Some(Job::Scan(_)) | None => break,
                Some(job) => panic!("{job:?}"),
            }
        }
        self.read();
    }

    /// Reads what the board reports; the numbers of requests that it refuses.
    fn read(&mut self) -> Vec<u8> {
        let (reported, mut refused) = (&mut self.reported, Vec::new());
        self.bench.drain(usize::MAX, |report| match report {
            Report::Reaction(report) => {
                let name = report.reaction.name.to_string();
                let known = reported.iter().position(|other| *other == name);
                match (report.reaction.active, known) {
                    (true, None) => reported.push(name),
                    (false, Some(at)) => _ = reported.remove(at),
                    (active, _) => panic!("{name} was reported as {active} twice"),
                }
            }
            Report::Answer(answer) => refused.extend(answer.refusal.map(|_| answer.request)),
            _ => {}
        });
        assert_eq!(self.bench.board.health().lost, 0);
        refused
    }

    fn give(&mut self, input: Input<'_>) {
        let now = Micros(self.bench.now);
        assert_eq!(self.bench.board.step(now, input, &mut ()), None);
    }

    fn examine(&mut self) {
        self.bench.now += 3_000;
        self.faults = self.broken;
        let faults = (0..self.faults as u8).map(|at| PinFault { pin: 2 + at, fault: Fault::StuckLow });
        self.give(Input::Examined(Ok(Findings { faults: faults.collect(), ..Findings::default() })));
    }

    fn scan(&mut self) {
        self.bench.scan();
        self.failed = false;
        let perceived = self.taring <= 1;
        if self.taring == 1 {
            self.tared = !self.spoiled;
        }
        self.taring = self.taring.saturating_sub(1);
        self.seen = perceived.then_some(self.bench.now);
        self.beat ^= perceived;
        self.settled += u32::from(perceived);
    }

    fn step(&mut self) {
        let choice = self.random.u8(..100);
        self.doing = format!("{} at {} us", choice, self.bench.now);
        match choice {
            0..40 => self.scan(),
            40..50 => {
                self.pressed = !self.pressed;
                self.bench.press(&FINGER, if self.pressed { 900 } else { 0 });
                self.settled = 0;
                self.spoiled |= self.taring > 0;
            }
            50..60 => {
                self.bench.now += 1_000;
                self.give(Input::Scanned(Err(ScanError::OutOfStep)));
                self.failed = true;
            }
            60..70 => self.bench.now += self.random.u64(500..50_000),
            70..76 => self.ask(&Request::Sync { token: 1 }),
            76..79 if !self.pressed => {
                // Refused where what was touched is still there.
                let frames = self.random.u16(1..4);
                let refused = self.is_refused(&Request::Tare { frames });
                if !refused {
                    (self.taring, self.settled, self.spoiled) = (frames.into(), 0, false);
                }
            }
            79..84 => {
                let mut other = scene();
                other.symbol.span_ms[0] += u32::from(self.random.bool());
                other.stream.frames_hz = self.random.u16(..30);
                if self.random.bool() {
                    other.react.pop();
                }
                if self.random.bool() {
                    other.react[0].name = name("sentinel");
                }
                let bytes = postcard::to_allocvec(&other).unwrap();
                assert!(!self.is_refused(&Request::SetScene(&bytes)));
                self.scene = other;
                self.settled = 0;
            }
            84..86 => {
                let bytes = postcard::to_allocvec(&Garment::block()).unwrap();
                assert!(!self.is_refused(&Request::SetGarment(&bytes)));
                (self.seen, self.taring, self.tared, self.settled) = (None, 0, false, 0);
                self.faults = 0;
            }
            86..88 => self.ask(&Request::Save),
            88..92 => {
                self.broken = self.random.usize(..3);
                self.ask(&Request::SelfTest);
            }
            92..94 => {
                let hz = self.random.u16(..20);
                self.ask(&Request::Stream { raw_hz: hz, budget_hz: 1 });
            }
            _ => {}
        }
    }

    /// Whether a request is refused at once.
    fn is_refused(&mut self, request: &Request<'_>) -> bool {
        self.settle();
        self.ask(request);
        self.read().contains(&request.number())
    }

    fn is_reported(&self, name: &str) -> bool {
        self.reported.iter().any(|other| other == name)
    }

    fn judge(&self) {
        let doing = &self.doing;
        let asserted = |pin: u8| {
            let line = self.scene.react.iter().filter_map(|row| row.output).find(|line| line.pin == pin);
            line.is_some_and(|line| self.pins[&pin] != line.inverted)
        };
        let must = |holds: bool, name: &str, pin: u8| {
            if holds {
                assert!(
                    self.is_reported(name) && asserted(pin),
                    "{doing}: {name} holds, reported: {:?}",
                    self.reported
                );
            }
        };
        let since = |then: u64| (self.bench.now - then) / 1000;
        must(self.seen.is_none_or(|seen| since(seen) >= BLIND_MS), "guard blind", 18);
        must(self.failed || self.faults > 0, "guard fault", 18);
        must(since(self.heard) >= SILENT_MS, "lonely", 20);
        let guard = self.scene.react[0].name.as_str();
        must(self.pressed && self.tared && self.settled >= SETTLED, guard, 18);
        // A pin is where its rows, as reported, want it.
        for pin in [18, 20, 25] {
            let rows = self.scene.react.iter().filter(|row| row.output.is_some_and(|line| line.pin == pin));
            let lasts = rows.map(|row| self.is_reported(&row.name)).reduce(|a, b| a || b);
            assert_eq!(
                asserted(pin),
                lasts.unwrap_or(false),
                "{doing}: pin {pin}, reported: {:?}",
                self.reported
            );
        }
        assert_eq!(self.pins.get(&24).copied().unwrap_or(false), self.beat, "{doing}: the sign of life");
    }

    /// When nothing holds any more, everything ends.
    fn end(&mut self) {
        self.bench.press(&FINGER, 0);
        (self.pressed, self.settled, self.broken) = (false, 0, 0);
        for round in 0..200 {
            // What else waits to be done comes first.
            if round % 50 == 0 {
                self.ask(&Request::SelfTest);
            }
            self.settle();
            self.scan();
            self.ask(&Request::Sync { token: 2 });
        }
        self.settle();
        self.judge();
        assert!(!self.tared || self.reported.is_empty(), "{:?}", self.reported);
    }
}

#[test]
fn no_pin_is_at_rest_while_its_cause_holds_and_no_end_is_unreported() {
    let sequences = if crate::is_campaign() { 100_000 } else { 1_000 };
    let mut steps = 0;
    for seed in 0..sequences {
        let mut judge = Judge::new(seed);
        for _ in 0..judge.random.usize(20..60) {
            judge.step();
            judge.settle();
            judge.judge();
            steps += 1;
        }
        judge.end();
    }
    println!(
        "{sequences} sequences of requests, faults and touches, {steps} steps: no pin at rest while its cause holds, no end unreported"
    );
}
