//! The health of lines, inputs and taxels on the emulated board, whose findings are those of the simulated one.
//! `cargo xtask test --only emulator-health`.

use crate::board::Emulated;
use crate::faults::{examine, pin_faults};
use std::collections::BTreeMap;
use taxel::files::scripts;
use taxel::sim::{FRAME_PERIOD_US, Script, frame_codes};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::health::TaxelHealth;
use taxel_core::scene::Scene;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::wire::{Report, Request, encode};

/// Frames of the baseline, and of it and what comes until it is asked for.
const TARE: u16 = 16;
const TARED: u64 = 30;
/// A fault is to be found so many frames after it can show.
const SOON: u64 = 100;

/// Asks for a self-test and waits for what it finds.
fn self_test(board: &mut Emulated) -> Findings {
    board.ask(&Request::SelfTest);
    let mut findings = None;
    loop {
        match board.receive().report() {
            Report::SelfTest(report) => findings = Some(report.findings),
            Report::Answer(answer) => {
                assert_eq!((answer.request, answer.refusal), (Request::SelfTest.number(), None));
                return findings.expect("the findings go before the answer");
            }
            _ => {}
        }
    }
}

#[test]
fn every_fault_of_a_line_or_an_input_is_reported_as_itself() {
    let garment = Garment::reference();
    let mut script = scripts::parse("duration_s = 1", "rest.toml").unwrap();
    // At rest near ground, as the simulated garment is not: its source moves it away from there.
    let mut board = Emulated::start(&garment, &vec![0; 2048], 0, &[]);
    // It hears nothing before it has started.
    board.receive();
    let whole = self_test(&mut board);
    assert_eq!(whole, examine(&garment, &script));
    assert!(whole.faults.is_empty(), "{whole:?}");
    let faults = pin_faults(&garment);
    for fault in &faults {
        board.fault(&[*fault]);
        let found = self_test(&mut board);
        assert_eq!(found.faults, [*fault]);
        script.faults.pins = vec![*fault];
        assert_eq!(found, examine(&garment, &script));
    }
    board.fault(&[]);
    assert_eq!(self_test(&mut board), whole);
    println!("{} faults of lines and inputs reported as themselves, as on the simulated board", faults.len());
    board.end();
}

/// While frames stream and nobody asks: one fault of each kind, after each of which the garment is whole again.
#[test]
fn what_breaks_in_use_is_reported_by_itself() {
    let garment = Garment::reference();
    let script = scripts::parse("duration_s = 1\nseed = 8", "rest.toml").unwrap();
    let codes = frame_codes(&script, &garment, FRAME_PERIOD_US, 61).unwrap();
    let mut board = Emulated::start(&garment, &codes, 90, &["--loop"]);
    board.receive();
    board.play();
    board.obey(&Request::Tare { frames: TARE });
    board.obey(&Request::Start);
    for (pin, fault) in [
        (3, Fault::StuckHigh),
        (12, Fault::StuckLow),
        (7, Fault::Bridged(8)),
        (26, Fault::Open),
        (28, Fault::Open),
        (27, Fault::Grounded),
        (29, Fault::Supplied),
    ] {
        let broken = loop {
            if let Report::Frame(image) = board.receive().report() {
                break image.time;
            }
        };
        board.fault(&[PinFault { pin, fault }]);
        let found = loop {
            match board.receive().report() {
                Report::SelfTest(report) if !report.findings.faults.is_empty() => break report,
                Report::Frame(image) => assert!(image.time.since(broken) < SOON * FRAME_PERIOD_US, "{fault}"),
                Report::HealthMap(map) => assert!(map.taxels.is_empty(), "{map:?}"),
                _ => {}
            }
        };
        assert_eq!(found.findings.faults, [PinFault { pin, fault }]);
        println!("GPIO {pin} {fault}: reported after {} us", found.time.since(broken));
        board.fault(&[]);
        assert!(self_test(&mut board).faults.is_empty());
    }
    board.end();
}

/// A stroke over a garment that is well; then a dead, a stuck and a noisy taxel; then something presses the
/// dead one and those around it. When they break, and when the dead one shows, in frames.
fn breaking(healthy: u64) -> (Script, u64, u64) {
    let broken = TARED + healthy;
    let seconds = |frames: u64| (frames * FRAME_PERIOD_US) as f64 / 1e6;
    let (pressed, end) = (broken + 5, broken + 20 + SOON);
    let script = scripts::parse(
        &format!(
            "duration_s = {:.4}\nseed = 5\n\
             [faults]\nfrom_s = {:.4}\ndead = [776]\nstuck = [{{ taxel = 100, code = 300 }}]\n\
             noisy = [{{ taxel = 1700, counts = 60.0 }}]\n\
             [[touch]]\npanel = \"left arm\"\nshape = \"ball\"\nsize_mm = 40\nat = [3, 4]\nvelocity = [10, 30]\n\
             force_n = 12\nstart_s = {:.4}\nrise_s = 0.05\nhold_s = 0.3\nfall_s = 0.05\n\
             [[touch]]\npanel = \"back\"\nshape = \"box\"\nsize_mm = [80, 70]\nat = [8, 16]\n\
             force_n = 50\nstart_s = {:.4}\nrise_s = 0.03\nhold_s = 5\n",
            seconds(end),
            seconds(broken),
            seconds(TARED),
            seconds(pressed),
        ),
        "breaking.toml",
    );
    (script.unwrap(), broken, pressed + 6)
}

/// What a board on this machine finds in these codes.
fn on_this_machine(codes: &[u16]) -> BTreeMap<u16, TaxelHealth> {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Shipped::new(info, Garment::reference(), Scene::shipped()).unwrap());
    let mut wire = [0; 64];
    let frame = encode(&Request::Tare { frames: TARE }, &mut wire).unwrap();
    board.step(Micros(0), Input::Received(frame), &mut ());
    for (frame, codes) in (1..).zip(codes.chunks(2048)) {
        let codes: Vec<Code> = codes.iter().map(|code| Code(*code)).collect();
        let report = ScanReport { start: Micros(frame * FRAME_PERIOD_US), ..ScanReport::default() };
        board.step(report.start, Input::Scanned(Ok(Scan { codes: &codes, report })), &mut ());
    }
    let faulty = (0..2048).map(|taxel| (taxel as u16, board.health_of(taxel)));
    faulty.filter(|(_, health)| *health != TaxelHealth::Good).collect()
}

#[test]
fn dead_stuck_and_noisy_taxels_are_reported_as_themselves() {
    let healthy = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1000 } else { 60 };
    let (script, broken, shown) = breaking(healthy);
    let garment = Garment::reference();
    let frames = (script.duration_s * 1e6) as u64 / FRAME_PERIOD_US;
    let codes = frame_codes(&script, &garment, FRAME_PERIOD_US, frames as usize).unwrap();
    let mut board = Emulated::start(&garment, &codes, 90, &[]);
    board.receive();
    let begin = board.play();
    board.obey(&Request::Tare { frames: TARE });
    board.obey(&Request::Start);
    let (mut found, mut frame) = (BTreeMap::new(), 0);
    while frame < frames - 1 {
        match board.receive().report() {
            Report::Frame(image) => frame = image.time.since(begin) / FRAME_PERIOD_US,
            Report::HealthMap(map) => {
                let at = map.time.since(begin) / FRAME_PERIOD_US;
                for faulty in map.taxels {
                    assert_eq!(faulty.count, 1);
                    found.entry(faulty.first).or_insert((at, faulty.health));
                }
            }
            _ => {}
        }
    }
    let stats = board.look("stats");
    board.end();
    println!(
        "{healthy} frames without a false word; broken in frame {broken}, pressed in frame {shown}: {found:?}"
    );
    println!(
        "{} s emulated in {} s",
        stats["emulated_us"].as_u64().unwrap() / 1_000_000,
        stats["wall_ms"].as_u64().unwrap() / 1_000
    );
    let classes: BTreeMap<u16, TaxelHealth> =
        found.iter().map(|(taxel, (_, health))| (*taxel, *health)).collect();
    let expected = [(100, TaxelHealth::Stuck), (776, TaxelHealth::Dead), (1700, TaxelHealth::Noisy)];
    assert_eq!(classes, BTreeMap::from(expected));
    assert_eq!(classes, on_this_machine(&codes));
    for (taxel, (at, health)) in found {
        let since = if health == TaxelHealth::Dead { shown } else { broken };
        assert!((since..=since + SOON).contains(&at), "taxel {taxel}, {health}: found in frame {at}");
    }
}
