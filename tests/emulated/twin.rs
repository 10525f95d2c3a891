//! The firmware image on the emulated board, and the same core on this machine: the reports must be the same,
//! byte for byte.

use crate::board::Emulated;
use std::collections::{BTreeMap, BTreeSet};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped, TableKind};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::{PressingReport, Receiver, Report, Request, decode, encode};

/// Full scale of the converter.
pub const FULL_SCALE: u16 = 4095;
/// Frames that are perceived per second: the link carries everything of the fullest one in time.
pub const RATE_HZ: u16 = 20;
/// Time from scan to scan, us, and how many of them show a frame: a little longer than from one perceived
/// frame to the next, so that each is perceived.
const SCAN_US: u64 = 5_120;
pub const DWELL: u64 = 10;

/// Reports that depend on the codes and their times alone, without `seq`, by the number of their scan.
type Reports = Vec<(u32, &'static str, Vec<u8>)>;

/// No drift on a garment that was not tared, and only so many frames as the link carries.
pub fn scene() -> Scene {
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
        Report::Pressing(pressing) => {
            // All but the time at which the poses arrived.
            let timeless = PressingReport { posed: pressing.posed.map(|_| Micros(0)), ..pressing.clone() };
            let report = Report::Pressing(timeless);
            kept.push((pressing.frame, "Pressing", postcard::to_allocvec(&report).unwrap()));
            return;
        }
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
    fn new(tables: &[(TableKind, &'static [u8])]) -> Twin {
        let info =
            BoardInfo { firmware: "", pins: Pins::ANY, full_scale: FULL_SCALE, link_bytes_per_s: 92_160 };
        let mut board = Shipped::new(info, Garment::reference(), Scene::shipped()).unwrap();
        tables.iter().for_each(|(kind, table)| board.recall_table(*kind, Some(table)));
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

/// Shows these frames, [`DWELL`] scans each, to a board that has these tables, and to its twin, both after
/// these requests. The reports of these kinds must be the same in
/// all frames; returns their numbers by kind.
pub fn same(
    board: &mut Emulated,
    tables: &[(TableKind, &'static [u8])],
    requests: &[Request<'_>],
    codes: &[u16],
    kinds: &[&str],
) -> BTreeMap<&'static str, u32> {
    requests.iter().for_each(|request| board.obey(request));
    let played = board.play();
    let count = (codes.len() / TAXELS) as u64;
    // The board takes the time of a scan some microseconds after its first address.
    let from = Micros(played.0 - SCAN_US / 2);
    let to = Micros(from.0 + count * DWELL * SCAN_US);
    let (mut reports, times) = from_board(board, from, to);
    reports.retain(|(_, kind, _)| kinds.contains(kind));
    let stats = board.look("stats");
    println!("{count} frames in {} us; stack {}", stats["emulated_us"], stats["stack"]);
    assert_eq!(stats["check"]["wrong"], 0);

    // Before the requests the twin is shown the scans that the board did before it streamed.
    let mut twin = Twin::new(tables);
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
    twin.reports.retain(|(frame, kind, _)| {
        kinds.contains(kind) && times.get(frame).is_some_and(|time| (from..to).contains(time))
    });
    compare(&reports, &twin.reports)
}

fn compare(board: &Reports, host: &Reports) -> BTreeMap<&'static str, u32> {
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
    kinds
}
