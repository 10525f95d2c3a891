//! The outputs of the firmware image: where they stand before the program runs, and when the converter stands
//! still. `cargo xtask test --only emulator-outputs`.

use crate::board::Emulated;
use fastrand::Rng;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use taxel_core::format::name;
use taxel_core::garment::{Garment, Line};
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::wire::{ContactList, Frame, Report, Request};

const BLIND_MS: i32 = 60;
/// The pins of the outputs: a shared one, one that is asserted low, one that only a touch asserts.
const PINS: &str = "18,19,20";
/// What the first instructions may take, us of the emulated 125 MHz: 2 ms of the 6.5 MHz of a chip that has
/// just started.
const FIRST_US: f64 = 2_000.0 * 6.5 / 125.0;

/// Time of the start until the self-test has found no fault, at least, us.
const STARTED_US: f64 = 50_000.0;

fn scene() -> Scene {
    let row = |text, cause, level, pin, inverted| {
        let (region, output) = (name(""), Some(Line { pin, inverted }));
        ReactionConfig { name: name(text), cause, region, level, hysteresis: 0, hold_ms: 0, output }
    };
    let mut scene = Scene { name: name("outputs"), ..Scene::shipped() };
    scene.react.clear();
    scene.react.extend([
        row("guard", Cause::Pressure, 300, 18, false),
        row("guard blind", Cause::Blind, BLIND_MS, 18, false),
        row("fault", Cause::Fault, 1, 19, true),
        row("touched", Cause::Pressure, 300, 20, false),
    ]);
    scene
}

fn flash(of: &str) -> PathBuf {
    let flash = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("outputs-{of}.bin"));
    let _ = std::fs::remove_file(&flash);
    flash
}

fn start(flash: &Path) -> Emulated {
    let options = ["--flash", flash.to_str().unwrap(), "--watch", PINS];
    Emulated::start(&Garment::reference(), &[100; 2048], 100, &options)
}

/// Waits for the answer to a request; what reactions were reported meanwhile.
fn done(board: &mut Emulated, request: &Request<'_>) -> Vec<(String, bool)> {
    board.ask(request);
    let mut reported = Vec::new();
    loop {
        match board.receive().report() {
            Report::Reaction(report) => {
                reported.push((report.reaction.name.to_string(), report.reaction.active))
            }
            Report::Answer(answer) if answer.request == request.number() => {
                assert_eq!(answer.refusal, None);
                return reported;
            }
            _ => {}
        }
    }
}

/// The next time that a reaction of this name begins or ends, us of the board.
fn when(board: &mut Emulated, name: &str, active: bool) -> u64 {
    loop {
        if let Report::Reaction(report) = board.receive().report()
            && (report.reaction.name.as_str(), report.reaction.active) == (name, active)
        {
            return report.time.0;
        }
    }
}

/// Edges of the pins that the harness has reported: pin, level, us.
fn edges(board: &mut Emulated) -> Vec<(u64, Option<bool>, f64)> {
    let mut edges = Vec::new();
    board.said.retain(|said| {
        let edge = &said["edge"];
        let Some(pin) = edge["pin"].as_u64() else { return true };
        edges.push((pin, edge["level"].as_bool(), edge["us"].as_f64().unwrap()));
        false
    });
    edges
}

/// What pins show and what messages report, side by side.
#[derive(Default)]
struct PinsAndMessages {
    /// Reactions that last, as reported.
    last: BTreeSet<String>,
    /// How often the reactions of a pin began, all of them being at rest.
    begun: BTreeMap<u64, u32>,
    /// Level of each pin, and how often it was asserted.
    pins: BTreeMap<u64, (bool, u32)>,
}

impl PinsAndMessages {
    fn reaction(&mut self, scene: &Scene, name: &str, active: bool) {
        let row = scene.react.iter().find(|row| row.name.as_str() == name).unwrap();
        let pin = u64::from(row.output.unwrap().pin);
        let of_pin = |name: &String| {
            let row = scene.react.iter().find(|row| row.name.as_str() == name).unwrap();
            u64::from(row.output.unwrap().pin) == pin
        };
        let rested = !self.last.iter().any(of_pin);
        // `Start` says once more what lasts.
        let is_new = if active { self.last.insert(name.into()) } else { self.last.remove(name) };
        assert!(active || is_new, "{name} ends twice");
        *self.begun.entry(pin).or_default() += u32::from(active && rested);
    }

    fn edges(&mut self, scene: &Scene, edges: &[(u64, Option<bool>, f64)]) {
        for (pin, level, _) in edges {
            let row = scene
                .react
                .iter()
                .find(|row| row.output.is_some_and(|line| u64::from(line.pin) == *pin))
                .unwrap();
            let asserted = level.expect("it is driven") != row.output.unwrap().inverted;
            let (now, count) = self.pins.entry(*pin).or_default();
            *count += u32::from(asserted && !*now);
            *now = asserted;
        }
    }
}

/// Reads on for so many seconds of the board.
fn read(board: &mut Emulated, seconds: f64, scene: &Scene, reported: &mut PinsAndMessages) {
    let mut until = None;
    loop {
        match board.receive().report() {
            Report::Reaction(report) => {
                reported.reaction(scene, &report.reaction.name, report.reaction.active)
            }
            Report::Answer(answer) => assert_eq!(answer.refusal, None, "{}", answer.request),
            Report::Contacts(ContactList { time, .. }) | Report::Frame(Frame { time, .. }) => {
                let end = *until.get_or_insert(time.0 + (seconds * 1e6) as u64);
                if time.0 >= end {
                    return;
                }
            }
            _ => {}
        }
    }
}

/// A finger of 2 x 2 taxels for a tenth of a second, and nothing.
fn finger() -> Vec<u16> {
    let mut frame = [100; 2048];
    [0, 1, 64, 65].iter().for_each(|taxel| frame[600 + taxel] = 2_000);
    // The last one stays.
    [frame.repeat(20), vec![100; 2048]].concat()
}

#[test]
fn pins_and_messages_agree_whatever_is_asked_and_whatever_fails() {
    let sequences = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 100 } else { 5 };
    let scene = scene();
    let options = ["--watch", PINS];
    let mut board = Emulated::start(&Garment::reference(), &finger(), 100, &options);
    board.receive();
    done(&mut board, &Request::SetScene(&postcard::to_allocvec(&scene).unwrap()));
    done(&mut board, &Request::Tare { frames: 4 });
    let (mut reported, mut random) = (PinsAndMessages::default(), Rng::with_seed(1));
    board.ask(&Request::Start);
    read(&mut board, 0.3, &scene, &mut reported);
    board.look("stats");
    reported.edges(&scene, &edges(&mut board));
    assert!(reported.last.is_empty(), "{:?} last at rest", reported.last);
    (reported.begun, reported.pins) = Default::default();
    let mut done = 0;
    for sequence in 0..sequences {
        for _ in 0..3 {
            done += 1;
            match random.u32(..7) {
                0 => _ = board.play(),
                1 => board.starve(3 + random.u32(..9)),
                2 => {
                    board.stall(true);
                    when_into(&mut board, "guard blind", &scene, &mut reported);
                    board.stall(false);
                }
                3 => {
                    let mut other = scene.clone();
                    other.symbol.span_ms[0] += random.u32(..9);
                    board.ask(&Request::SetScene(&postcard::to_allocvec(&other).unwrap()));
                    // Over a UART, more than 1,000 bytes at once could be lost (docs/reference/wire.md).
                    when_answered(&mut board, &scene, &mut reported);
                }
                4 => board.ask(&Request::Stream { raw_hz: random.u32(..5) as u16, budget_hz: 1 }),
                5 => board.ask(&Request::SelfTest),
                _ => board.ask(&Request::Start),
            }
        }
        read(&mut board, 0.4, &scene, &mut reported);
        board.look("stats");
        reported.edges(&scene, &edges(&mut board));
        for (pin, (asserted, count)) in &reported.pins {
            assert!(!asserted, "sequence {sequence}: GP{pin} is asserted at rest");
            assert_eq!(Some(count), reported.begun.get(pin), "sequence {sequence}: GP{pin}");
        }
        assert!(reported.last.is_empty(), "sequence {sequence}: {:?}", reported.last);
    }
    let asserted: u32 = reported.pins.values().map(|(_, count)| count).sum();
    println!(
        "{sequences} sequences of {done} requests, faults and touches: pins were asserted {asserted} times, each reported, and each end"
    );
    board.end();
}

/// Reads on until a change of the scene is answered.
fn when_answered(board: &mut Emulated, scene: &Scene, reported: &mut PinsAndMessages) {
    loop {
        match board.receive().report() {
            Report::Reaction(report) => {
                reported.reaction(scene, &report.reaction.name, report.reaction.active)
            }
            Report::Answer(answer) => {
                assert_eq!(answer.refusal, None, "{}", answer.request);
                if answer.request == Request::SetScene(&[]).number() {
                    return;
                }
            }
            _ => {}
        }
    }
}

/// Reads on until a reaction of this name begins.
fn when_into(board: &mut Emulated, name: &str, scene: &Scene, reported: &mut PinsAndMessages) {
    while !reported.last.contains(name) {
        if let Report::Reaction(report) = board.receive().report() {
            reported.reaction(scene, &report.reaction.name, report.reaction.active);
        }
    }
}

#[test]
fn pins_stand_at_their_fault_levels_before_the_program_runs() {
    let flash = flash("first");
    let mut board = start(&flash);
    let scene = postcard::to_allocvec(&scene()).unwrap();
    board.receive();
    done(&mut board, &Request::SetScene(&scene));
    done(&mut board, &Request::Save);
    board.end();

    let mut board = start(&flash);
    board.receive();
    board.look("stats");
    let edges = edges(&mut board);
    for (pin, level) in [(18, true), (19, false), (20, false)] {
        let of_pin: Vec<_> = edges.iter().filter(|edge| edge.0 == pin).collect();
        let (_, first, us) = of_pin[0];
        println!(
            "GP{pin}: {} after {us:.1} us of 125 MHz, {:.2} ms of 6.5 MHz",
            u8::from(level),
            us * 125.0 / 6.5e3
        );
        assert!(*first == Some(level) && *us <= FIRST_US, "GP{pin}: {of_pin:?}");
        // Undriven while the clocks start, else at that level; a touch has nothing to say yet.
        assert!(
            of_pin.iter().all(|edge| edge.1.is_none_or(|shown| shown == level) || edge.2 > STARTED_US),
            "{of_pin:?}"
        );
    }
    board.end();
}

#[test]
fn a_converter_that_stands_still_is_reported_as_blindness_and_frames_come_again() {
    let mut board = start(&flash("stall"));
    let bytes = postcard::to_allocvec(&scene()).unwrap();
    board.receive();
    done(&mut board, &Request::Start);
    done(&mut board, &Request::SetScene(&bytes));
    for _ in 0..3 {
        let stalled = board.stall(true);
        let reported = when(&mut board, "guard blind", true) as f64;
        let after_ms = (reported - stalled) / 1e3;
        println!("blind {after_ms:.1} ms after the converter stood still, at a level of {BLIND_MS} ms");
        assert!((f64::from(BLIND_MS) - 6.0..=f64::from(BLIND_MS) + 25.0).contains(&after_ms), "{after_ms}");
        board.stall(false);
        when(&mut board, "guard blind", false);
    }
    board.end();
}
