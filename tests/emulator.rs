//! The firmware image on the emulated board: five moving contacts at full speed. `cargo xtask test --only emulator`.

mod emulated;

use emulated::{Emulated, Message};
use serde_json::Value;
use std::collections::BTreeMap;
use taxel::sim::{frame_codes, load, scale_rate};
use taxel_core::garment::Garment;
use taxel_core::wire::{Report, Request, decode_image, image_sum};

/// Frames that are looked at.
const FRAMES: u32 = 300;
/// About the time from frame to frame with five contacts, us.
const PERIOD_US: u64 = 14_000;
/// The scene lasts 2.5 s: played at this rate, all five contacts move during all frames.
const RATE: f64 = 0.42;
/// Frames of the scene before the first touch at 0.2 s, and how often they are shown.
const IDLE: usize = 13;
const IDLE_ROUNDS: usize = 4;
/// Frames from the first touch to the end of the rise.
const RISE: usize = 12;
const TAXELS: usize = 2048;

/// Idle frames over and over, then the scene.
fn codes(garment: &Garment) -> Vec<u16> {
    let script = scale_rate(&load("five").unwrap(), RATE);
    let frames = frame_codes(&script, garment, PERIOD_US, IDLE + RISE + FRAMES as usize + 20).unwrap();
    let (idle, scene) = frames.split_at(IDLE * TAXELS);
    [idle.repeat(IDLE_ROUNDS), scene.to_vec()].concat()
}

/// Images as a host keeps them.
#[derive(Default)]
struct Images {
    last: Option<(u32, Vec<u16>)>,
}

impl Images {
    /// Number and time of the scan of a `Frame`, whose image must be the one that the board had.
    fn take(&mut self, message: &Message) -> Option<(u32, u64)> {
        let Report::Frame(frame) = message.report() else { return None };
        let mut image = vec![0; TAXELS];
        let base = frame.base.map(|number| {
            let (last, base) = self.last.as_ref().expect("a difference to no frame");
            assert_eq!(*last, number, "the difference is to another frame");
            base.as_slice()
        });
        decode_image(frame.data, base, &mut image).unwrap();
        assert_eq!(image_sum(&image), frame.sum, "frame {}", frame.frame);
        self.last = Some((frame.frame, image));
        Some((frame.frame, frame.time.0))
    }
}

#[test]
fn five_moving_contacts() {
    let garment = Garment::reference();
    let mut board = Emulated::start(&garment, &codes(&garment), 90, &[]);
    let played = board.play();
    board.obey(&Request::Tare { frames: 16 });
    board.obey(&Request::Start);
    let first = played + (IDLE * IDLE_ROUNDS + RISE) as u32;
    let mut images = Images::default();
    let mut before = None;
    while before.as_ref().is_none_or(|(number, _)| *number + 1 != first) {
        let message = board.receive();
        before = images.take(&message).inspect(|(number, _)| assert!(*number < first)).or(before);
    }
    let marks = board.look("stats");
    let (mut frame, start) = before.unwrap();
    let (mut end, mut contacts, mut bytes) = (start, Vec::new(), BTreeMap::new());
    while frame + 1 < first + FRAMES {
        let message = board.receive();
        if let Some((number, time)) = images.take(&message) {
            assert_eq!(number, frame + 1, "a frame was thinned");
            (frame, end) = (number, time);
        }
        if let Report::Contacts(list) = message.report() {
            contacts.push(list.contacts.len());
        }
        *bytes.entry(kind(&message.report())).or_insert(0) += message.wire_bytes;
    }
    let spent = board.look("stats");
    assert!(contacts.len() as u32 + 2 > FRAMES && contacts.iter().all(|n| *n == 5), "{contacts:?}");
    let health = loop {
        if let Report::Health(health) = board.receive().report() {
            break health;
        }
    };
    let rate = f64::from(FRAMES) * 1e6 / (end - start) as f64;
    println!("{rate:.1} frames/s, a scan takes {} us; stack {}", health.scan_us, spent["stack"]);
    tell_stages(&marks, &spent);
    let total: usize = bytes.values().sum();
    println!("bytes per frame: {} of all kinds; {:?}", total / FRAMES as usize, mean(&bytes));
    assert_eq!((health.thinned_frames, health.thinned_contacts), (0, 0));
    assert_eq!((health.lost, health.failed, health.overruns, health.refused), (0, 0, 0, 0));
    assert!(rate >= 60.0);
    board.end();
}

fn kind(report: &Report<'_>) -> String {
    format!("{report:?}").split(['(', ' ']).next().unwrap_or("").to_string()
}

fn mean(bytes: &BTreeMap<String, usize>) -> BTreeMap<&str, usize> {
    bytes.iter().map(|(kind, sum)| (kind.as_str(), sum / FRAMES as usize)).collect()
}

/// Prints the cycles that each stage took between two looks at the marks, per scan.
fn tell_stages(before: &Value, after: &Value) {
    const STAGES: [&str; 9] =
        ["outside", "condition", "contact", "shape", "symbol", "intent", "react", "encode", "scan"];
    let spent = |stage: usize, what: &str| {
        let at = |stats: &Value| stats["marks"][stage.to_string()][what].as_u64().unwrap_or(0);
        at(after) - at(before)
    };
    let scans = spent(8, "count").max(1);
    for (stage, name) in STAGES.iter().enumerate() {
        println!("{name:>10} {:>8} cycles", spent(stage, "cycles") / scans);
    }
}
