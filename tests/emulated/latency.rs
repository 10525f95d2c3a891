//! How late the board says, and does, what it feels: from the moment at which voltages rise, whatever the
//! scan is at then. `cargo xtask test --only emulator-latency`; TAXEL_CAMPAIGN=1 (`cargo xtask campaign`):
//! more touches.

use crate::board::Emulated;
use taxel::files::scripts::load;
use taxel::sim::frame_codes;
use taxel_core::capacity::TAXELS;
use taxel_core::contact::Phase;
use taxel_core::format::Code;
use taxel_core::garment::Garment;
use taxel_core::intent::Leading;
use taxel_core::reflex::Agree;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};
use taxel_suite::pattern::TouchPattern;

/// Columns of a panel, and taxels.
const COLUMNS: usize = 16;
const PANEL: usize = 32 * COLUMNS;
/// Time from scan to scan, us.
const SCAN_US: f64 = 5_120.0;
/// How long a touch lasts, and the rest before the next one, us: from touch to touch the scan's phase moves
/// on by 0.618 of its period, which spreads the touches evenly over it.
const PERIOD_US: f64 = 22_062.0;
/// Rests before the first touch: the board is asked to tare meanwhile.
const RESTS: usize = 24;
/// Most contacts at a time.
const MOST: usize = 5;
/// Code of a touched taxel: above the scene's limit of pressure.
const PRESSED: u16 = 4_000;
/// Pin of the reaction to too much pressure, and to an attack.
const PRESSURE_PIN: u64 = 18;
const ATTACK_PIN: u64 = 19;
/// The 99th percentiles that are allowed, us: of a contact's first message over USB, and of a reflex.
const ONSET_US: f64 = 12_000.0;
const REFLEX_US: f64 = 2.0 * SCAN_US;

/// Touches that are done: each number of contacts as often.
fn touches() -> usize {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 500 } else { 50 }
}

/// Touches after them, while the cable is pulled.
const ALONE: usize = 10;

/// Contacts of a touch.
const fn contacts(touch: usize) -> usize {
    touch % MOST + 1
}

/// Upper left taxels of the contacts of a touch: anywhere on the garment, apart from each other and from the
/// seams.
fn places(touch: usize) -> impl Iterator<Item = usize> {
    let mut random = touch as u32;
    (0..contacts(touch)).map(move |contact| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let (column, row) = (2 + (random >> 16) as usize % 9, (random >> 24) as usize % 12);
        let row = row + if contact < 4 { 0 } else { 17 };
        (touch + contact) % 4 * PANEL + row * COLUMNS + column
    })
}

/// Rest and touch in turn, each once; a contact is 3 x 3 taxels.
fn codes() -> Vec<u16> {
    let mut frames = Vec::new();
    let empty = |number: usize| {
        let mut codes = [Code(0); TAXELS];
        TouchPattern::Empty.codes(number as u32, &mut codes);
        codes.map(|code| code.0)
    };
    (0..RESTS).for_each(|number| frames.extend(empty(number)));
    for touch in 0..touches() + ALONE {
        let mut pressed = empty(touch);
        for place in places(touch) {
            (0..9).for_each(|at| pressed[place + at / 3 * COLUMNS + at % 3] = PRESSED);
        }
        frames.extend(pressed);
        frames.extend(empty(touch + 1));
    }
    frames
}

/// The shipped scene, whose reactions end as soon as their cause does.
fn scene() -> Scene {
    let mut scene = Scene::shipped();
    scene.react.iter_mut().for_each(|row| row.hold_ms = 1);
    scene
}

/// Times in us.
struct Times(Vec<f64>);

impl Times {
    /// The least that so many percent of them do not exceed.
    fn percentile(&self, percent: usize) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        sorted[(sorted.len() * percent).div_ceil(100) - 1]
    }

    fn print(&self, what: &str) {
        let ms = |percent| self.percentile(percent) / 1000.0;
        println!(
            "{what}: median {:.2} ms, p99 {:.2} ms, largest {:.2} ms of {}",
            ms(50),
            ms(99),
            ms(100),
            self.0.len()
        );
    }
}

/// A time that the harness reported.
fn us(line: &serde_json::Value) -> f64 {
    line["us"].as_f64().unwrap()
}

/// Begins to play, in this scene, tared at rest: when the voltage of a touch rises, us of the board.
fn begin(board: &mut Emulated, scene: &[u8]) -> impl Fn(usize) -> f64 + use<> {
    let begun = board.play().0 as f64;
    let requests = [Request::SetScene(scene), Request::Tare { frames: 16 }, Request::Start];
    requests.iter().for_each(|request| board.ask(request));
    move |touch| begun + (RESTS + 2 * touch) as f64 * PERIOD_US
}

#[test]
fn from_voltage_to_message_and_pin() {
    let period = PERIOD_US.to_string();
    let options = ["--link", "usb", "--period", &period, "--times", "--watch", "18"];
    let mut board = Emulated::start(&Garment::reference(), &codes(), 100, &options);
    let scene = postcard::to_allocvec(&scene()).unwrap();
    let mut bytes = board.receive().wire_bytes as u64;
    let rise = begin(&mut board, &scene);
    // Number of bytes at the end of the message, and start of the scan, for each contact that begins.
    let mut onsets = Vec::new();
    loop {
        let message = board.receive();
        bytes += message.wire_bytes as u64;
        match message.report() {
            Report::Contacts(list) => {
                let begins = list.contacts.iter().filter(|placed| placed.contact.phase == Phase::Onset);
                onsets.extend(begins.map(|_| (bytes, list.time.0 as f64)));
            }
            Report::Frame(frame) if frame.time.0 as f64 > rise(touches()) => break,
            Report::Answer(answer) => assert_eq!(answer.refusal, None),
            _ => {}
        }
    }
    board.look("unplug");
    while (board.look("stats")["emulated_us"].as_f64().unwrap()) < rise(touches() + ALONE) {}
    let said = std::mem::take(&mut board.said);
    board.end();
    let ends: std::collections::BTreeMap<u64, f64> = said
        .iter()
        .filter_map(|line| line.get("end"))
        .map(|end| (end["bytes"].as_u64().unwrap(), us(end)))
        .collect();
    let edges: Vec<f64> = said
        .iter()
        .filter_map(|line| line.get("edge"))
        .filter(|edge| edge["pin"] == PRESSURE_PIN && edge["level"] == true)
        .map(us)
        .collect();
    let reflex = |touch: usize| edges.iter().find(|edge| **edge > rise(touch)).unwrap() - rise(touch);
    let mut all = Vec::new();
    let mut of_number: [Vec<f64>; MOST] = Default::default();
    let mut reflexes = Vec::new();
    for touch in 0..touches() {
        let (from, to) = (rise(touch), rise(touch + 1));
        let of_touch: Vec<_> = onsets.iter().filter(|(end, _)| (from..to).contains(&ends[end])).collect();
        assert_eq!(of_touch.len(), contacts(touch), "touch {touch}");
        // A scan that begins after the rise sees the whole touch: it is the first such one, or the one
        // before.
        assert!(of_touch.iter().all(|(_, start)| *start <= from + SCAN_US), "touch {touch}");
        let late = of_touch.iter().map(|(end, _)| ends[end] - from);
        of_number[contacts(touch) - 1].extend(late.clone());
        all.extend(late);
        reflexes.push(reflex(touch));
    }
    let alone: Vec<f64> = (touches()..touches() + ALONE).map(reflex).collect();
    for (number, times) in (1..).zip(of_number) {
        let times = Times(times);
        times.print(&format!("onset over USB, {number} contacts"));
        assert!(times.percentile(99) <= ONSET_US, "{number} contacts");
    }
    let (all, reflexes, alone) = (Times(all), Times(reflexes), Times(alone));
    all.print("onset over USB, all");
    reflexes.print("reflex to pressure");
    alone.print("reflex to pressure, the cable pulled");
    assert!(all.percentile(99) <= ONSET_US);
    assert!(reflexes.percentile(99) <= REFLEX_US);
    assert!(alone.percentile(99) <= REFLEX_US);
}

/// Percentiles that are allowed of a reflex within a frame, us: by one taxel's word, and where two must
/// agree.
const ONE_US: f64 = 1_500.0;
const TWO_US: f64 = 2_200.0;

/// Rest and touch in turn: one contact of 3 x 3, 4 x 4 or 5 x 5 taxels, anywhere on the garment. The noise of
/// 7 counts differs from one to the next in most taxels: those that stood still for too long would be stuck,
/// and left out.
fn footprints() -> Vec<u16> {
    let empty = |number: usize| {
        (0..TAXELS).map(move |taxel| 100 + ((number * 7919 + taxel * 104_729) >> 3) as u16 % 7)
    };
    let mut frames: Vec<u16> = (0..RESTS).flat_map(empty).collect();
    let mut random = 1u32;
    let mut below = |n: usize| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((u64::from(random) * n as u64) >> 32) as usize
    };
    for touch in 0..touches() {
        let side = 3 + touch % 3;
        let place = below(4) * PANEL + below(33 - side) * COLUMNS + below(17 - side);
        let mut pressed: Vec<u16> = empty(touch).collect();
        (0..side * side).for_each(|at| pressed[place + at / side * COLUMNS + at % side] = PRESSED);
        frames.extend(pressed);
        frames.extend(empty(touch + 1));
    }
    frames
}

/// From the voltage to the pin in an interlaced scan, which reports each reflex once.
fn reflexes(agree: Agree) -> Times {
    let period = PERIOD_US.to_string();
    let options = ["--link", "usb", "--period", &period, "--times", "--watch", "18"];
    let mut board = Emulated::start(&Garment::reference(), &footprints(), 100, &options);
    let scene = postcard::to_allocvec(&scene().interlaced(agree)).unwrap();
    board.receive();
    let rise = begin(&mut board, &scene);
    let mut reported = Vec::new();
    loop {
        match board.receive().report() {
            Report::Reflex(reflex) => reported.push(reflex),
            Report::HealthMap(map) => assert!(map.taxels.is_empty(), "{map:?}"),
            Report::Frame(frame) if frame.time.0 as f64 > rise(touches()) => break,
            Report::Answer(answer) => assert_eq!(answer.refusal, None),
            _ => {}
        }
    }
    // Its answer comes after all that was said before.
    board.look("stats");
    let said = std::mem::take(&mut board.said);
    board.end();
    let edges: Vec<f64> = said
        .iter()
        .filter_map(|line| line.get("edge"))
        .filter(|edge| edge["pin"] == PRESSURE_PIN && edge["level"] == true)
        .map(us)
        .collect();
    assert_eq!((reported.len(), edges.len()), (touches(), touches()));
    for (touch, (reflex, edge)) in reported.iter().zip(&edges).enumerate() {
        assert!((rise(touch)..rise(touch) + PERIOD_US).contains(edge), "touch {touch}");
        // The pin moves when the check is through.
        assert!((0.0..100.0).contains(&(edge - reflex.time.0 as f64)), "touch {touch}: {reflex:?} {edge}");
        assert_eq!((reflex.index, reflex.other.is_some()), (0, agree == Agree::Two));
    }
    Times(edges.iter().enumerate().map(|(touch, edge)| edge - rise(touch)).collect())
}

#[test]
fn a_reflex_within_a_frame() {
    for (agree, what, most) in
        [(Agree::One, "one taxel's word", ONE_US), (Agree::Two, "two that agree", TWO_US)]
    {
        let times = reflexes(agree);
        times.print(&format!("interlaced: reflex by {what}"));
        assert!(times.percentile(99) <= most);
    }
}

#[test]
fn an_attack_moves_a_pin_in_the_frame_that_decides_it() {
    let garment = Garment::reference();
    let script = load("lash").unwrap();
    let codes = frame_codes(&script, &garment, SCAN_US as u64, 300).unwrap();
    let mut board = Emulated::start(&garment, &codes, 100, &["--watch", "19", "--seconds", "3"]);
    board.receive();
    board.obey(&Request::Tare { frames: 16 });
    board.obey(&Request::Start);
    // What the untared garment seemed to feel counts on for half a second.
    while !matches!(board.receive().report(), Report::Frame(frame) if frame.time.0 > 700_000) {}
    board.play();
    let decided = loop {
        if let Report::Intent(intent) = board.receive().report()
            && intent.leading == Leading::Attack
        {
            break intent.time.0 as f64;
        }
    };
    let edge = loop {
        let edge = board.wait_for("edge");
        if edge["edge"]["pin"] == ATTACK_PIN && edge["edge"]["level"] == true {
            break us(&edge["edge"]);
        }
    };
    board.end();
    println!("pin {:.2} ms after the start of the scan that decided", (edge - decided) / 1000.0);
    // The scan takes one period, and the next one is not over yet.
    assert!((SCAN_US..2.0 * SCAN_US).contains(&(edge - decided)));
}
