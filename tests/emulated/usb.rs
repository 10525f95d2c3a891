//! The board on USB, in the emulator: what arrives, what it costs, and a cable that is pulled.
//! `cargo xtask test --only emulator-usb`; TAXEL_CAMPAIGN=1 (`cargo xtask campaign`): all scenes of the
//! bench, for longer.

mod starts;

use crate::board::Emulated;
use crate::images::{Images, TAXELS};
use crate::surface::moving::{Moving, bend};
use crate::surface::{store, table};
use crate::twin::RobotState;
use std::collections::BTreeMap;
use taxel_core::board::TableKind;
use taxel_core::format::Code;
use taxel_core::garment::{Garment, Layout};
use taxel_core::reflex::Agree;
use taxel_core::scene::Scene;
use taxel_core::wire::{Budget, Report, Request};
use taxel_suite::folds::FOLDS;
use taxel_suite::pattern::TouchPattern;

/// Time from scan to scan, us.
const SCAN_US: u64 = 5_120;
/// Scans at rest: the board is asked to tare and to stream meanwhile.
const REST: usize = 100;
/// Scans of a scene's beginning that are not looked at: contacts begin, and lists are long.
const BEGIN: usize = 8;
/// Cycles that chain, link and interrupts may take together of the 640,000 from any scan to the next; and
/// with the check of each sub-field of an interlaced scan.
const MOST_CYCLES: u64 = 600_000;
const MOST_INTERLACED: u64 = 630_000;
/// The cycles, of the mean and the most, that are held against a bar: rustup's library keeps frame pointers,
/// which cost 3 to 6 % more. Its images keep to the bars in the mean, and miss no scan.
fn judged((mean, most): (u64, u64)) -> u64 {
    if has_frame_pointers() { mean } else { most }
}

/// True if the image has rustup's library.
fn has_frame_pointers() -> bool {
    let library = std::env::var("TAXEL_LIBRARY").expect("run by `cargo xtask test`, which names it");
    library.ends_with("with frame pointers")
}

/// A scene, and whether all of its images must come.
type Shown = (TouchPattern, bool);

/// What is shown, and for how many scans each.
fn shown() -> (Vec<Shown>, usize) {
    let shown = |patterns: &[TouchPattern]| {
        patterns.iter().map(|pattern| (*pattern, !matches!(pattern, TouchPattern::Texture))).collect()
    };
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() {
        (shown(&TouchPattern::ALL), 400)
    } else {
        (
            shown(&[
                TouchPattern::Empty,
                TouchPattern::One,
                TouchPattern::Five,
                TouchPattern::Grid,
                TouchPattern::Texture,
            ]),
            60,
        )
    }
}

/// A rest, then the scenes one after the other.
fn codes(shown: &[Shown], scans: usize) -> Vec<u16> {
    let scenes = shown.iter().flat_map(|(pattern, _)| std::iter::repeat_n(*pattern, scans));
    let frames = std::iter::repeat_n(TouchPattern::Empty, REST).chain(scenes).zip(0..);
    frames.flat_map(|(pattern, number)| codes_of(pattern, number)).collect()
}

fn codes_of(pattern: TouchPattern, number: u32) -> [u16; TAXELS] {
    let mut codes = [Code(0); TAXELS];
    pattern.codes(number, &mut codes);
    codes.map(|code| code.0)
}

/// A board on USB that streams, with a budget for each frame; when the first frame was shown. `begin` sends
/// it what it needs before.
fn streaming(
    scene: &Scene,
    codes: &[u16],
    options: &[&str],
    begin: impl Fn(&mut Emulated),
) -> (Emulated, u64) {
    let mut board =
        Emulated::start(&Garment::reference(), codes, 100, &[&["--link", "usb"], options].concat());
    let known = board.wait_for("usb");
    assert_eq!((&known["usb"]["id"], &known["usb"]["name"]), (&"1209:0001".into(), &"taxel".into()));
    board.receive();
    begin(&mut board);
    // Before the frames begin: the scan stands still for a moment, and they would be late from then on.
    board.obey(&Request::SetScene(&postcard::to_allocvec(scene).unwrap()));
    let played = board.play().0;
    board.obey(&Request::Tare { frames: 16 });
    board.obey(&Request::Stream { raw_hz: 0, budget_hz: u16::MAX });
    board.obey(&Request::Start);
    (board, played)
}

/// What came of a scene.
#[derive(Default)]
struct Came {
    /// Numbers of the frames whose images came.
    images: Vec<u32>,
    budgets: Vec<Budget>,
    bytes: usize,
    /// Numbers of contacts that were reported, and of the taxels under them.
    felt: Vec<(usize, u32)>,
}

impl Came {
    /// Prints a line, and compares what came with what was counted as left out. `cycles`: from scan to scan,
    /// the mean and the most.
    fn check(&self, (pattern, whole): Shown, cycles: (u64, u64), most: u64) {
        let (first, last) = (self.budgets[0], self.budgets[self.budgets.len() - 1]);
        let scans = ((last.time.since(first.time) + SCAN_US / 2) / SCAN_US) as u32;
        let (frames, overruns) = (last.frame - first.frame, last.overruns - first.overruns);
        let images =
            self.images.iter().filter(|frame| (first.frame..last.frame).contains(frame)).count() as u32;
        let thinned = last.thinned_frames - first.thinned_frames;
        let mean = |of: fn(&Budget) -> u32| {
            self.budgets.iter().map(|budget| u64::from(of(budget))).sum::<u64>() / self.budgets.len() as u64
        };
        println!(
            "{:>12}  {:6.1} frames/s  images {images:>4} of {scans:>4} scans  overruns {overruns:>4}  thinned {thinned:>3}  \
             {:>5} bytes a frame  process {:>5} us  encode {:>4} us  link {:>4} us  {:>6} cycles from scan to scan, {} at most",
            pattern.name(),
            f64::from(frames) * 1e6 / last.time.since(first.time) as f64,
            self.bytes / self.images.len(),
            mean(|b| b.process_us),
            mean(|b| b.encode_us),
            mean(|b| b.send_us),
            cycles.0,
            cycles.1,
        );
        assert_eq!(frames + overruns, scans, "each scan is perceived, or counted as left out");
        assert!((images + thinned).abs_diff(frames) <= 1, "each image comes, or is counted as left out");
        assert!(self.budgets.iter().all(|budget| budget.frames == 1));
        if whole {
            assert_eq!((images, overruns, thinned), (scans, 0, 0));
        }
        assert_eq!(overruns, 0, "each scan is perceived");
        assert!(judged(cycles) <= most, "{cycles:?} of {most}");
    }
}

#[test]
fn what_is_perceived_arrives() {
    let shown = shown();
    let played = codes(&shown.0, shown.1);
    arrives(&Scene::shipped(), MOST_CYCLES, &shown, &played, |_| {}, |_| None);
}

#[test]
fn what_is_perceived_arrives_interlaced() {
    let shown = shown();
    let played = codes(&shown.0, shown.1);
    let scene = Scene::shipped().interlaced(Agree::Two);
    arrives(&scene, MOST_INTERLACED, &shown, &played, |_| {}, |_| None);
}

/// A robot that moves, in a garment that folds over 512 taxels: its posture and its poses are sent fifty
/// times a second, and what presses where in the base comes with each frame.
fn arrives_of_a_moving_body(patterns: &[Shown], most: u64) -> BTreeMap<usize, Came> {
    let shown = (patterns.to_vec(), 60);
    let layout = Layout::build(&Garment::reference(), TAXELS, 4095).unwrap();
    let moving = Moving::new(&Garment::reference(), &layout);
    let mut played = codes(&shown.0, shown.1);
    bend(&mut played, &layout);
    let mut scene = Scene::shipped().interlaced(Agree::Two);
    scene.stream.pressing_hz = u16::MAX;
    let tables = [(TableKind::Surface, table().0), (TableKind::Folds, &FOLDS.0[..])];
    let begin = |board: &mut Emulated| store(board, &tables);
    arrives(&scene, most, &shown, &played, begin, |us| Some(moving.sent(us)))
}

#[test]
fn what_is_perceived_of_a_moving_body_arrives_interlaced() {
    arrives_of_a_moving_body(&[(TouchPattern::One, true), (TouchPattern::Five, true)], MOST_INTERLACED);
}

/// Sixteen contacts on some 500 taxels, a fourth of them on the fold, leave little time between two scans,
/// also where a posture comes. Each scan is perceived and reported, with its image; with frame pointers, images
/// may be left out, and are counted.
#[test]
fn sixteen_contacts_on_a_moving_body_leave_no_scan_out() {
    let came = arrives_of_a_moving_body(&[(TouchPattern::Sixteen, !has_frame_pointers())], MOST_INTERLACED);
    let felt = &came[&0].felt;
    assert!(felt.len() >= 50, "each scan is reported");
    assert!(
        felt.iter().all(|(contacts, taxels)| *contacts == 16 && (490..=512).contains(taxels)),
        "{felt:?}"
    );
}

/// Time from one posture that is sent to the next, us.
const SENT_US: u64 = 20_000;

/// Shows scenes and compares what comes of each with what was counted. `begin` sends the board what it needs
/// before, `state_at` where the robot is, by the time since the first scan that is shown.
fn arrives(
    used: &Scene,
    most: u64,
    (shown, scans): &(Vec<Shown>, usize),
    codes: &[u16],
    begin: impl Fn(&mut Emulated),
    state_at: impl Fn(u64) -> Option<RobotState>,
) -> BTreeMap<usize, Came> {
    let scans = *scans;
    let window = scans - BEGIN;
    let (mut board, played) = streaming(used, codes, &["--every", "1"], begin);
    let mut due = 0;
    // Number of the scene to which a scan belongs that began then.
    let scene = |time: u64| {
        let scan = ((time + SCAN_US / 2).saturating_sub(played) / SCAN_US) as usize;
        let since = scan.checked_sub(REST)?;
        (since % scans >= BEGIN).then_some(since / scans)
    };
    let (mut images, mut came) = (Images::default(), BTreeMap::<usize, Came>::new());
    loop {
        let message = board.receive();
        if let Some((number, time)) = images.take(&message) {
            let since = time.saturating_sub(played);
            if since >= due
                && let Some(sent) = state_at(since)
            {
                board.ask(&Request::Posture(sent.posture));
                board.ask(&Request::SetPoses(&sent.poses));
                due = since - since % SENT_US + SENT_US;
            }
            let Some(of) = scene(time) else { continue };
            if of >= shown.len() {
                break;
            }
            came.entry(of).or_default().images.push(number);
        }
        let latest = match message.report() {
            Report::Budget(budget) => {
                let of = scene(budget.time.0).filter(|of| *of < shown.len());
                of.inspect(|of| came.entry(*of).or_default().budgets.push(budget))
            }
            Report::Contacts(list) => {
                let of = scene(list.time.0);
                if let Some(came) = of.and_then(|of| came.get_mut(&of)) {
                    let taxels = list.contacts.iter().map(|placed| u32::from(placed.contact.area)).sum();
                    came.felt.push((list.contacts.len(), taxels));
                }
                of
            }
            Report::Frame(frame) => scene(frame.time.0),
            _ => None,
        };
        if let Some(came) = latest.and_then(|of| came.get_mut(&of)) {
            came.bytes += message.wire_bytes;
        }
    }
    let stats = board.look("stats");
    let passed: Vec<(u64, u64)> = std::mem::take(&mut board.said)
        .iter()
        .filter_map(|line| Some((line["passed"]["us"].as_f64()? as u64, line["passed"]["cycles"].as_u64()?)))
        .collect();
    board.end();
    for (of, came) in &came {
        let start = played + ((REST + of * scans + BEGIN) as u64) * SCAN_US;
        let first = passed.iter().position(|(time, _)| time + SCAN_US / 2 > start).unwrap();
        let scans = passed[first..first + window].windows(2).map(|two| two[1].1 - two[0].1);
        let mean = scans.clone().sum::<u64>() / (window as u64 - 1);
        came.check(shown[*of], (mean, scans.max().unwrap()), most);
    }
    println!("USB {}; stack {}; {} us", stats["usb"], stats["stack"], stats["emulated_us"]);
    assert_eq!(came.len(), shown.len());
    came
}

/// Scans of forty contacts while the interrupt is at odds with the main loop.
const RACED: usize = 400;

/// The main loop and the interrupt both hand packets to the controller. Neither may overwrite the other's:
/// each image is compared with its sum, and the computer compares the toggle of each packet.
#[test]
fn an_interrupt_at_any_instruction_loses_no_packet() {
    let codes = codes(&[(TouchPattern::Grid, true)], RACED);
    let (mut board, _) = streaming(&Scene::shipped(), &codes, &["--race", "link7packets5begin"], |_| {});
    let mut images = Images::default();
    let first = next_frame(&mut board, &mut images).0;
    while next_frame(&mut board, &mut images).0 < first + RACED as u32 {}
    let stats = board.look("stats");
    println!("USB {}; {} interrupts", stats["usb"], stats["races"]);
    assert!(stats["races"].as_u64().unwrap() > 300, "less than once before each instruction");
    board.end();
}

/// Time of the board that is looked at, us.
const FLOODED_US: u64 = 1_500_000;

#[test]
fn a_flood_of_requests_stops_no_scan() {
    let scene = postcard::to_allocvec(&Scene::shipped()).unwrap();
    let garment = postcard::to_allocvec(&Garment::reference()).unwrap();
    // How often each is asked for, and the scans a second that remain at least. After a change of the
    // garment, and in each self-test, all lines are examined; there is one between two scans.
    let floods = [
        ("SetScene", Request::SetScene(&scene), 1_000, 180.0),
        ("SetGarment", Request::SetGarment(&garment), 1_000, 100.0),
        ("SelfTest", Request::SelfTest, 4_000, 60.0),
    ];
    for (of, request, times, least) in floods {
        let (mut board, _) = streaming(&Scene::shipped(), &codes_of(TouchPattern::Empty, 0), &[], |_| {});
        next_frame(&mut board, &mut Images::default());
        // What the host loses does not matter here: after each change the numbers of frames go on.
        board.forgiving = true;
        (0..times).for_each(|_| board.ask(&request));
        let (mut first, mut last, mut answers) = (None, (0, 0), 0);
        while first.is_none_or(|(_, time)| last.1 < time + FLOODED_US) {
            match board.receive().report() {
                Report::Budget(budget) => {
                    last = (budget.frame, budget.time.0);
                    first = first.or(Some(last).filter(|_| answers > 0));
                }
                Report::Answer(answer) if answer.request == request.number() => answers += 1,
                _ => {}
            }
        }
        let (frame, time) = first.unwrap();
        let rate = f64::from(last.0 - frame) * 1e6 / (last.1 - time) as f64;
        println!("{of} without end: {rate:.1} scans/s, {answers} answers");
        assert!(rate > least, "{of}: {rate:.1} scans/s");
        assert!(answers < times, "{of}: the flood has ended too early");
        board.end();
    }
}

#[test]
fn a_cable_may_be_pulled_and_put_again() {
    let codes: Vec<u16> = [TouchPattern::Empty, TouchPattern::One]
        .into_iter()
        .flat_map(|pattern| codes_of(pattern, 0))
        .collect();
    let (mut board, _) = streaming(&Scene::shipped(), &codes, &["--seconds", "3"], |_| {});
    let first = next_frame(&mut board, &mut Images::default());
    let before = board.look("unplug").as_f64().unwrap() as u64;
    let sent = |board: &mut Emulated| board.look("stats")["uart"].as_u64().unwrap();
    let over_uart = sent(&mut board);
    while board.look("stats")["emulated_us"].as_u64().unwrap() < before + 30_000 {}
    assert!(sent(&mut board) > over_uart, "the board goes on over the UART");
    board.forgiving = true;
    board.look("plug");
    board.wait_for("usb");
    board.ask(&Request::Start);
    // As a host does that has just opened the port: what differs from an image that it has not is not for it.
    let again = loop {
        let message = board.receive();
        if matches!(message.report(), Report::Frame(frame) if frame.base.is_none() && frame.time.0 > before) {
            break Images::default().take(&message).unwrap();
        }
    };
    println!("pulled at {before} us; image {first:?} before, {again:?} after");
    assert_eq!(
        (again.1 - first.1 + SCAN_US / 2) / SCAN_US,
        u64::from(again.0 - first.0),
        "no scan was left out"
    );
    board.end();
}

fn next_frame(board: &mut Emulated, images: &mut Images) -> (u32, u64) {
    loop {
        if let Some(seen) = images.take(&board.receive()) {
            return seen;
        }
    }
}
