//! The firmware image on the emulated board: five moving contacts at full speed.
//! `cargo xtask test --only emulator`; TAXEL_CAMPAIGN=1 (`cargo xtask campaign`): for 4.1 s.

use crate::board::Emulated;
use crate::images::{Images, TAXELS};
use serde_json::Value;
use std::collections::BTreeMap;
use taxel::files::scripts::load;
use taxel::sim::{frame_codes, scale_rate};
use taxel_core::garment::Garment;
use taxel_core::wire::{Report, Request};

/// Time from scan to scan, us.
const SCAN_US: u64 = 5_120;
/// The scene lasts 2.5 s: played at this rate, all five contacts move during all of them.
const RATE: f64 = 0.42;
/// Scans of the scene before the first touch at 0.2 s, and how often they are shown: the emulator waits for
/// nobody, and a busy machine asks for the tare late.
const IDLE: usize = 90;
const IDLE_ROUNDS: usize = 6;
/// Scans from the first touch to the end of the rise.
const RISE: usize = 35;

/// Scans that are looked at: 4.1 s, else 1.3.
fn scans() -> usize {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 800 } else { 250 }
}

/// Idle frames over and over, then the scene.
fn codes(garment: &Garment) -> Vec<u16> {
    let script = scale_rate(&load("five").unwrap(), RATE);
    let frames = frame_codes(&script, garment, SCAN_US, IDLE + RISE + scans() + 50).unwrap();
    let (idle, scene) = frames.split_at(IDLE * TAXELS);
    [idle.repeat(IDLE_ROUNDS), scene.to_vec()].concat()
}

#[test]
fn five_moving_contacts() {
    let garment = Garment::reference();
    let mut board = Emulated::start(&garment, &codes(&garment), 90, &[]);
    let played = board.play();
    board.obey(&Request::Tare { frames: 16 });
    board.obey(&Request::Start);
    let risen = played.0 + (IDLE * IDLE_ROUNDS + RISE) as u64 * SCAN_US;
    let mut images = Images::default();
    let first = loop {
        let message = board.receive();
        if let Some((number, time)) = images.take(&message).filter(|(_, time)| *time >= risen) {
            break (number, time);
        }
    };
    let marks = board.look("stats");
    let (mut last, mut shown, mut contacts, mut bytes) = (first, 0, Vec::new(), BTreeMap::new());
    while last.1 < first.1 + scans() as u64 * SCAN_US {
        let message = board.receive();
        if let Some(seen) = images.take(&message) {
            (last, shown) = (seen, shown + 1);
        }
        if let Report::Contacts(list) = message.report() {
            contacts.push(list.contacts.len());
        }
        *bytes.entry(kind(&message.report())).or_insert(0) += message.wire_bytes;
    }
    let spent = board.look("stats");
    let health = loop {
        if let Report::Health(health) = board.receive().report() {
            break health;
        }
    };
    let frames = last.0 - first.0;
    let rate = f64::from(frames) * 1e6 / (last.1 - first.1) as f64;
    println!("{rate:.1} frames/s perceived, a scan takes {} us; stack {}", health.scan_us, spent["stack"]);
    println!("of {frames} frames {shown} images and {} lists of contacts were sent", contacts.len());
    println!("{}", spent["check"]);
    print_stages(&marks, &spent);
    println!("bytes per frame: {:?}", mean(&bytes, frames as usize));
    assert!(contacts.iter().all(|n| *n == 5), "{contacts:?}");
    assert!(contacts.len() as u32 + 1 >= frames, "contacts go before images: a list for each frame");
    assert_eq!((health.lost, health.failed, health.refused), (0, 0, 0));
    assert_eq!(spent["check"]["wrong"], 0);
    assert_eq!(health.scan_us, SCAN_US as u32);
    assert!(rate >= 195.0);
    board.end();
}

fn kind(report: &Report<'_>) -> String {
    format!("{report:?}").split(['(', ' ']).next().unwrap_or("").to_string()
}

fn mean(bytes: &BTreeMap<String, usize>, frames: usize) -> BTreeMap<&str, usize> {
    bytes.iter().map(|(kind, sum)| (kind.as_str(), sum / frames)).collect()
}

/// Prints the cycles that each stage took between two looks at the marks, per scan.
fn print_stages(before: &Value, after: &Value) {
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
