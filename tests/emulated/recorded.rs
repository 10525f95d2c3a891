//! Recorded people on a mat, perceived by the firmware image on the emulated board and by the same core on
//! this machine: the reports must be the same, byte for byte. `cargo xtask test --only emulator-recorded`.

use crate::board::Emulated;
use crate::data;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use taxel::files::arrays::read_all;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

/// Full scale of the converter.
const FULL_SCALE: u16 = 4095;
/// Of a recording, every so many frames.
const STEP: usize = 16;
/// Frames that are perceived per second: the link carries everything of the fullest one in time.
const RATE_HZ: u16 = 20;
/// Time from scan to scan, us, and how many of them show a frame: a little longer than from one perceived
/// frame to the next, so that each is perceived.
const SCAN_US: u64 = 5_120;
const DWELL: u64 = 10;

/// Reports that depend on the codes and their times alone, without `seq`, by the number of their scan.
type Reports = Vec<(u32, &'static str, Vec<u8>)>;

/// The recordings in `folder` whose names end like that.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let listed = std::fs::read_dir(data::find(folder)).expect("a folder");
    let mut files: Vec<PathBuf> = listed.map(|file| file.unwrap().path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(end));
    files.sort();
    assert!(!files.is_empty(), "{folder} holds no *{end}");
    files
}

/// Every 16th frame of each posture and its last, and all trousers, as codes.
fn codes() -> Vec<u16> {
    let mut codes = Vec::new();
    for path in [files("pmatdata", ".npz"), files("smart_garment", "-pants.npy")].concat() {
        for (name, frames) in read_all(&path).unwrap() {
            assert_eq!((frames.rows, frames.columns), (64, 32), "{} {name}", path.display());
            let last = frames.count - 1;
            let kept = frames.iter().enumerate().filter(|(n, _)| n % STEP == 0 || *n == last);
            codes.extend(kept.flat_map(|(_, frame)| frame).map(|value| (*value).min(FULL_SCALE)));
        }
    }
    codes
}

/// No drift on a mat that was not tared, and only so many frames as the link carries.
fn scene() -> Scene {
    let mut scene = Scene::shipped();
    scene.rate_hz = RATE_HZ;
    scene.condition.track_baseline = false;
    scene
}

/// Keeps a report if it is one of those to compare.
fn keep(kept: &mut Reports, report: &Report<'_>) {
    let (frame, kind) = match report {
        Report::Frame(frame) => (frame.frame, "Frame"),
        Report::Contacts(list) => (list.frame, "Contacts"),
        Report::Symbols(list) => (list.frame, "Symbols"),
        Report::Intent(intent) => (intent.frame, "Intent"),
        Report::Reaction(reaction) => (reaction.frame, "Reaction"),
        Report::Gesture(gesture) => (gesture.frame, "Gesture"),
        Report::Confidence(confidence) => (confidence.frame, "Confidence"),
        _ => return,
    };
    kept.push((frame, kind, postcard::to_allocvec(report).unwrap()));
}

/// What the board says of frames that began at `from` and later, to the first of `to` and later, and when
/// each began.
fn from_board(board: &mut Emulated, from: Micros, to: Micros) -> (Reports, BTreeMap<u32, Micros>) {
    let (mut reports, mut times, mut bytes) = (Reports::new(), BTreeMap::new(), 0);
    let mut thinned = None;
    // The image is the last report of a frame; the next health report tells whether one was left out.
    while thinned.is_none() {
        let message = board.receive();
        let report = message.report();
        bytes += message.wire_bytes;
        keep(&mut reports, &report);
        match report {
            Report::Frame(frame) => _ = times.insert(frame.frame, frame.time),
            Report::Health(health) if times.values().any(|time| *time >= to) => {
                thinned = Some((health.thinned_frames, health.thinned_contacts, health.lost, health.failed));
            }
            _ => {}
        }
    }
    assert_eq!(thinned, Some((0, 0, 0, 0)), "too fast for the link");
    println!("{} bytes on the wire per frame", bytes / times.len());
    reports.retain(|(frame, ..)| times.get(frame).is_some_and(|time| (from..to).contains(time)));
    (reports, times)
}

/// A board on this machine, fed with the same requests and scans.
struct Twin {
    board: Box<Shipped>,
    receiver: Receiver<8192>,
    reports: Reports,
}

impl Twin {
    fn new() -> Twin {
        let info =
            BoardInfo { firmware: "", pins: Pins::ANY, full_scale: FULL_SCALE, link_bytes_per_s: 92_160 };
        let board = Shipped::new(info, Garment::reference(), Scene::shipped()).unwrap();
        Twin { board: Box::new(board), receiver: Receiver::new(), reports: Reports::new() }
    }

    fn ask(&mut self, request: &Request<'_>) {
        let mut wire = vec![0; 4096];
        let frame = encode(request, &mut wire).unwrap();
        self.board.step(Micros(0), Input::Received(frame), &mut ());
    }

    fn scan(&mut self, codes: &[Code], start: Micros) {
        let report = ScanReport { start, duration_us: 0, overruns: 0, temperature: None };
        self.board.step(start, Input::Scanned(Ok(Scan { codes, report })), &mut ());
        loop {
            let bytes = self.board.pending(start, &mut ()).to_vec();
            self.board.sent(bytes.len());
            for byte in &bytes {
                let Some(body) = self.receiver.push(*byte) else { continue };
                keep(&mut self.reports, &decode::<(u32, Report<'_>)>(body.unwrap()).unwrap().1);
            }
            if bytes.is_empty() {
                break;
            }
        }
    }
}

#[test]
fn recorded_people() {
    let codes = codes();
    let garment = postcard::to_allocvec(&Garment::mat()).unwrap();
    let scene = postcard::to_allocvec(&scene()).unwrap();
    // A person on a mat makes no gestures; what the model says of them must be the same all the same.
    let gestures =
        GestureConfig { rate_hz: RATE_HZ, decide_ms: 50, onset_ms: 50, lead: 0, ..GestureConfig::default() };
    let gestures = Request::SetGestures(Some(gestures));
    let requests = [Request::SetGarment(&garment), Request::SetScene(&scene), gestures, Request::Start];
    let mut board = Emulated::start(&Garment::mat(), &codes, 0, &["--dwell", &DWELL.to_string()]);
    let mut twin = Twin::new();
    // It hears nothing before it has started.
    board.receive();
    requests.iter().for_each(|request| board.obey(request));
    let played = board.play();
    let count = (codes.len() / TAXELS) as u64;
    // The board takes the time of a scan some microseconds after its first address.
    let from = Micros(played.0 - SCAN_US / 2);
    let to = Micros(from.0 + count * DWELL * SCAN_US);
    let (reports, times) = from_board(&mut board, from, to);
    let stats = board.look("stats");
    println!("{count} frames in {} us; stack {}", stats["emulated_us"], stats["stack"]);
    assert_eq!(stats["check"]["wrong"], 0);
    board.end();

    // Before the requests the twin is shown the scans that the board did before it streamed.
    let first = *times.keys().next().unwrap();
    (1..first).for_each(|_| twin.scan(&[Code(0); TAXELS], Micros(0)));
    requests.iter().for_each(|request| twin.ask(request));
    let mut perceived = BTreeSet::new();
    for (_, time) in times.range(first..).take_while(|(_, time)| **time < to) {
        let frame = (*time >= from).then(|| time.since(from) / (DWELL * SCAN_US));
        perceived.extend(frame);
        let shown = frame.and_then(|n| codes.chunks(TAXELS).nth(n as usize));
        let codes: Vec<Code> = shown.unwrap_or(&[0; TAXELS]).iter().map(|code| Code(*code)).collect();
        twin.scan(&codes, *time);
    }
    assert_eq!(perceived.len() as u64, count, "each frame is perceived");
    twin.reports.retain(|(frame, ..)| times.get(frame).is_some_and(|time| (from..to).contains(time)));
    compare(&reports, &twin.reports);
}

fn compare(board: &Reports, host: &Reports) {
    let (mut kinds, mut bytes) = (BTreeMap::new(), 0);
    for (ours, theirs) in host.iter().zip(board) {
        assert!(
            ours == theirs,
            "host {} of {}, board {} of {}:\n{:?}\n{:?}",
            ours.1,
            ours.0,
            theirs.1,
            theirs.0,
            decode::<Report<'_>>(&ours.2),
            decode::<Report<'_>>(&theirs.2)
        );
        *kinds.entry(ours.1).or_insert(0) += 1;
        bytes += ours.2.len();
    }
    assert_eq!(board.len(), host.len());
    println!("{bytes} bytes of reports are the same: {kinds:?}");
    assert!(
        ["Contacts", "Symbols", "Intent", "Frame", "Gesture"].iter().all(|kind| kinds.contains_key(kind))
    );
}
