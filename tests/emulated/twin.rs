//! The firmware image on the emulated board, and the same core on this machine: the reports must be the same,
//! byte for byte.

use crate::board::Emulated;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped, TableKind};
use taxel_core::capacity::TAXELS;
use taxel_core::fold::Posture;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

/// Full scale of the converter.
pub const FULL_SCALE: u16 = 4095;
/// Frames that are perceived per second: the link carries everything of the fullest one in time.
pub const RATE_HZ: u16 = 20;
/// Time from scan to scan, us, and how many of them show a frame: a little longer than from one perceived
/// frame to the next, so that each is perceived.
pub const SCAN_US: u64 = 5_120;
pub const DWELL: u64 = 10;

/// Reports that depend on the codes and their times alone, without `seq`, by the number of their scan.
pub type Reports = Vec<(u32, &'static str, Vec<u8>)>;

/// What both boards are shown and asked.
#[derive(Clone, Copy)]
pub struct Course<'a> {
    /// Tables that they have from the start.
    pub tables: &'a [(TableKind, &'static [u8])],
    /// Requests before the frames begin. Where reports of folds are compared, the last one is a scene: they are
    /// ten a second from its first frame on.
    pub requests: &'a [Request<'a>],
    /// Codes, frame by frame.
    pub codes: &'a [u16],
    /// Scans that show each frame.
    pub dwell: u64,
}

/// Where the robot is, as it is sent while frames are shown.
pub struct RobotState {
    /// Time since the first frame, us.
    pub us: u64,
    /// Angles of the joints that fold the garment.
    pub posture: Posture,
    /// Poses of the links, as [`Request::SetPoses`] has them.
    pub poses: Vec<u8>,
}

/// A message to the board, and when it arrived there.
struct Sent {
    sent: RobotState,
    posture_at: Option<Micros>,
    /// Of the poses, and the first frame that was reported in them: the report of what presses is made when the
    /// link has room for it.
    poses_at: Option<(Micros, u32)>,
}

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
        Report::Pressing(pressing) => (pressing.frame, "Pressing"),
        Report::Folds(folds) => (folds.frame, "Folds"),
        Report::Gesture(gesture) => (gesture.frame, "Gesture"),
        _ => return,
    };
    kept.push((frame, kind, postcard::to_allocvec(report).unwrap()));
}

/// Reports of the emulated board.
#[derive(Default)]
struct Heard {
    reports: Reports,
    /// When each frame began.
    times: BTreeMap<u32, Micros>,
    /// The frames whose images stand alone.
    keys: BTreeSet<u32>,
    sent: Vec<Sent>,
    /// When posture and poses in force arrived, as last sent.
    posed: [Option<Micros>; 2],
    /// When those arrived that were sent before the frames began.
    before: Micros,
}

impl Heard {
    /// Listens until the frames that began at `from` and later have come, to the first of `to` and later.
    /// With every report of folds the board is sent what `state_at` has for that time after `from`.
    fn listen(
        &mut self,
        board: &mut Emulated,
        (from, to): (Micros, Micros),
        state_at: &dyn Fn(u64) -> Option<RobotState>,
    ) {
        let (mut before, mut thinned, mut bytes) = (None, None, 0);
        // The image is the last report of a frame; the next health report says whether one was left out. One
        // that was left out before these frames, when the scene changed, does not matter; one of the frames is
        // missed by whoever compares them.
        while thinned.is_none() {
            let message = board.receive();
            let report = message.report();
            bytes += message.wire_bytes;
            self.take(&report);
            match report {
                Report::Health(health) => {
                    let before = *before.get_or_insert(health.thinned_frames);
                    if self.times.values().any(|time| *time >= to) {
                        let frames = health.thinned_frames - before;
                        thinned = Some((frames, health.thinned_contacts, health.lost, health.failed));
                    }
                }
                Report::Folds(folds) => {
                    let are_known =
                        self.sent.iter().all(|it| it.posture_at.is_some() && it.poses_at.is_some());
                    let sent = state_at(folds.time.since(from)).filter(|_| are_known && folds.time < to);
                    let Some(sent) = sent.filter(|_| folds.time >= from) else { continue };
                    board.ask(&Request::Posture(sent.posture.clone()));
                    board.ask(&Request::SetPoses(&sent.poses));
                    self.sent.push(Sent { sent, posture_at: None, poses_at: None });
                }
                _ => {}
            }
        }
        assert_eq!(thinned, Some((0, 0, 0, 0)), "too fast for the link");
        println!("{} bytes on the wire per frame", bytes / self.times.len());
    }

    /// Listens to the next report of folds; the number of its frame.
    fn next_folds(&mut self, board: &mut Emulated) -> u32 {
        loop {
            let message = board.receive();
            self.take(&message.report());
            if let Report::Folds(folds) = message.report() {
                return folds.frame;
            }
        }
    }

    fn take(&mut self, report: &Report<'_>) {
        keep(&mut self.reports, report);
        match report {
            Report::Frame(frame) => {
                self.times.insert(frame.frame, frame.time);
                self.keys.extend(frame.base.is_none().then_some(frame.frame));
            }
            Report::Answer(answer) => assert_eq!(answer.refusal, None),
            Report::Pressing(pressing) => self.arrived(1, pressing.posed, pressing.frame),
            Report::Folds(folds) => self.arrived(0, folds.posed, folds.frame),
            _ => {}
        }
    }

    /// Notes the time at which the board received the posture (0) or the poses (1) that it has in a frame.
    fn arrived(&mut self, which: usize, posed: Option<Micros>, frame: u32) {
        if std::mem::replace(&mut self.posed[which], posed) == posed {
            return;
        }
        match self.sent.last_mut() {
            Some(sent) if which == 0 => sent.posture_at = posed,
            Some(sent) => sent.poses_at = posed.map(|posed| (posed, frame)),
            None => self.before = posed.unwrap_or(self.before),
        }
    }
}

/// A board on this machine, fed with the same requests and scans.
struct Twin {
    board: Box<Shipped>,
    receiver: Receiver<8192>,
    reports: Reports,
}

impl Twin {
    fn new(tables: &[(TableKind, &'static [u8])]) -> Twin {
        let info = BoardInfo {
            firmware: "",
            chip: "",
            pins: Pins::ANY,
            full_scale: FULL_SCALE,
            link_bytes_per_s: 92_160,
        };
        let mut board = Shipped::new(info, Garment::reference(), Scene::shipped()).unwrap();
        tables.iter().for_each(|(kind, table)| board.recall_table(*kind, Some(table)));
        Twin { board: Box::new(board), receiver: Receiver::new(), reports: Reports::new() }
    }

    fn ask(&mut self, request: &Request<'_>, now: Micros) {
        let mut wire = vec![0; 4096];
        let frame = encode(request, &mut wire).unwrap();
        self.board.step(now, Input::Received(frame), &mut ());
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

/// Shows frames to a board and to its twin, both after the same requests. The reports of these kinds must be
/// the same in all frames; returns their numbers by kind.
pub fn same(board: &mut Emulated, course: &Course<'_>, kinds: &[&str]) -> BTreeMap<&'static str, u32> {
    let (reports, _) = followed(board, course, kinds, &|_| None);
    let mut counts = BTreeMap::new();
    reports.iter().for_each(|(_, kind, _)| *counts.entry(*kind).or_insert(0) += 1);
    counts
}

/// Compares reports like [`same`] while the robot moves: `state_at` says where it is, by the time since the first
/// frame, us; it is asked with each report of folds. Returns the reports, and what was sent, with the times at
/// which the poses arrived.
pub fn followed(
    board: &mut Emulated,
    course: &Course<'_>,
    kinds: &[&str],
    state_at: &dyn Fn(u64) -> Option<RobotState>,
) -> (Reports, Vec<(Micros, RobotState)>) {
    let Course { tables, requests, codes, dwell } = *course;
    let mut heard = Heard::default();
    let begun = match requests.split_last() {
        Some((last, before)) if kinds.contains(&"Folds") => {
            before.iter().for_each(|request| board.obey(request));
            // Just after such a report the next one is the first in the new scene.
            while !matches!(board.receive().report(), Report::Folds(_)) {}
            board.ask(last);
            Some(heard.next_folds(board))
        }
        _ => {
            requests.iter().for_each(|request| board.obey(request));
            // Nothing touches in this frame. Without it the twin would not know whether the board saw the first
            // touch come.
            while heard.times.is_empty() {
                heard.take(&board.receive().report());
            }
            None
        }
    };
    // Of an image that is left out while the scene changes, the twin knows nothing: a later one stands alone.
    board.ask(&Request::KeyFrame);
    let played = board.play();
    let count = (codes.len() / TAXELS) as u64;
    // The board takes the time of a scan some microseconds after its first address.
    let from = Micros(played.0 - SCAN_US / 2);
    let to = Micros(from.0 + count * dwell * SCAN_US);
    heard.listen(board, (from, to), state_at);
    let Heard { mut reports, times, keys, sent, before, .. } = heard;
    let first = begun.unwrap_or(*times.keys().next().unwrap());
    let is_compared = |(frame, kind, _): &(u32, &str, Vec<u8>)| {
        kinds.contains(kind) && times.get(frame).is_some_and(|time| (from..to).contains(time))
    };
    reports.retain(is_compared);
    let stats = board.look("stats");
    println!("{count} frames in {} us; stack {}", stats["emulated_us"], stats["stack"]);
    assert_eq!(stats["check"]["wrong"], 0);

    // Before the requests the twin is shown the scans that the board did before it streamed.
    let mut twin = Twin::new(tables);
    (1..first).for_each(|_| twin.scan(&[Code(0); TAXELS], Micros(0)));
    requests.iter().for_each(|request| twin.ask(request, before));
    let (mut postures, mut poses) = (VecDeque::new(), VecDeque::new());
    for Sent { sent, posture_at, poses_at } in &sent {
        postures.extend(posture_at.map(|at| (at, Request::Posture(sent.posture.clone()))));
        poses.extend(poses_at.map(|(at, frame)| (frame, at, Request::SetPoses(&sent.poses))));
    }
    let mut perceived = BTreeSet::new();
    // An image that was left out had a scan before the next one.
    let (next, at) = times.range(first..).next().unwrap();
    let mut time = Micros(at.0 - u64::from(next - first + 1) * SCAN_US);
    let shown = times.range(first..).take_while(|(_, time)| **time < to);
    for number in first..=shown.last().map_or(first, |(last, _)| *last) {
        let known = times.get(&number);
        time = known.copied().unwrap_or(Micros(time.0 + SCAN_US));
        // Each scan is perceived at once: what comes until its end is obeyed before it.
        while let Some((at, request)) = postures.pop_front_if(|(at, _)| at.0 < time.0 + SCAN_US) {
            twin.ask(&request, at);
        }
        while let Some((_, at, request)) = poses.pop_front_if(|(frame, ..)| *frame <= number) {
            twin.ask(&request, at);
        }
        if keys.contains(&number) {
            // They come each second from the start of the stream, which the twin has not seen.
            twin.ask(&Request::KeyFrame, time);
        }
        let frame = known.filter(|time| **time >= from).map(|time| time.since(from) / (dwell * SCAN_US));
        perceived.extend(frame);
        let shown = frame.and_then(|n| codes.chunks(TAXELS).nth(n as usize));
        let codes: Vec<Code> = shown.unwrap_or(&[0; TAXELS]).iter().map(|code| Code(*code)).collect();
        twin.scan(&codes, time);
    }
    let missed: Vec<u64> = (0..count).filter(|frame| !perceived.contains(frame)).collect();
    assert!(missed.is_empty(), "frames that were not perceived: {missed:?}");
    twin.reports.retain(is_compared);
    compare(&reports, &twin.reports);
    let sent = sent.into_iter().filter_map(|it| Some((it.poses_at?.0, it.sent))).collect();
    (reports, sent)
}

fn compare(board: &Reports, host: &Reports) {
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
    }
    assert_eq!(board.len(), host.len());
    let bytes: usize = board.iter().map(|(.., report)| report.len()).sum();
    println!("{} reports of {bytes} bytes are the same", board.len());
}
