//! Ill taxels, lines and inputs on the simulated board: each is found, and told as what it is; no other is.

mod faults;

use faults::{examine, pin_faults};
use std::collections::BTreeMap;
use taxel::sim::{self, Noisy, PINS, Script, SimBoard, Stuck, rewire};
use taxel_core::acquire::{Acquire, Depth, MuxScan};
use taxel_core::board::{Board, BoardInfo, Input, Job};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Panel, Pins};
use taxel_core::health::TaxelHealth;
use taxel_core::run::block_on;
use taxel_core::scene::Scene;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

const TAXELS: usize = 2048;
/// Frames of the baseline.
const TARE: u16 = 16;

/// A simulated board, and what it finds.
struct Worn {
    garment: Garment,
    board: Box<Board<TAXELS, 1024>>,
}

impl Worn {
    fn new() -> Worn {
        Worn::at(Depth::Twelve)
    }

    /// The codes have this depth.
    fn at(depth: Depth) -> Worn {
        let mut scene = Scene::shipped();
        scene.plan.depth = depth;
        let info = BoardInfo { firmware: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
        let garment = Garment::reference();
        let board = Box::new(Board::new(info, garment.clone(), scene).unwrap());
        Worn { garment, board }
    }

    /// Plays so many frames of a script after a tare; the frame in which each ill taxel was found, and its class.
    fn play(&mut self, script: &Script, frames: u32) -> BTreeMap<usize, (u32, TaxelHealth)> {
        let SimBoard { mut lines, delay, adc, clock } =
            SimBoard::new(&self.garment, script, script.seed).unwrap();
        let mut scan = MuxScan::<_, _, _, _, PINS, TAXELS>::new(&mut lines, delay, adc, clock);
        let (mut body, mut wire) = ([0; 64], [0; 64]);
        let length = encode(&Request::Tare { frames: TARE }, &mut body, &mut wire).unwrap();
        self.board.step(Micros(0), Input::Received(&wire[..length]), &mut ());
        let mut found = BTreeMap::new();
        for frame in 0..u32::from(TARE) + frames {
            let circuit = self.board.circuit().clone();
            let scanned = block_on(scan.scan(&circuit, &self.board.setup().scene.plan)).unwrap();
            let now = Micros(scanned.report.start.0 + 5_000);
            self.board.step(now, Input::Scanned(Ok(scanned)), &mut ());
            for taxel in 0..TAXELS {
                let health = self.board.health_of(taxel);
                if health != TaxelHealth::Good {
                    found.entry(taxel).or_insert((frame, health));
                }
            }
        }
        found
    }
}

/// Touches of any kind, anywhere, one after the other and several at a time.
fn varied(seconds: f64, seed: u64) -> Script {
    let mut rng = fastrand::Rng::with_seed(seed);
    let mut text = format!("duration_s = {seconds}\nseed = {seed}\n");
    let mut start = 0.2;
    while start < seconds {
        let panel = rng.choice(Garment::reference().panels).unwrap().name;
        let shape = rng.choice(["box", "ball", "finger"]).unwrap();
        let mut within = |low: f64, high: f64| low + rng.f64() * (high - low);
        let size = match shape {
            "box" => format!("[{:.0}, {:.0}]", within(20.0, 180.0), within(20.0, 200.0)),
            "ball" => format!("{:.0}", within(30.0, 120.0)),
            _ => format!("{:.0}", within(12.0, 20.0)),
        };
        text += &format!(
            "[[touch]]\npanel = \"{panel}\"\nshape = \"{shape}\"\nsize_mm = {size}\nat = [{:.1}, {:.1}]\n\
             velocity = [{:.1}, {:.1}]\nforce_n = {:.1}\nstart_s = {start:.3}\nrise_s = {:.3}\nhold_s = {:.3}\n\
             fall_s = {:.3}\n",
            within(0.0, 15.0),
            within(0.0, 31.0),
            within(-20.0, 20.0),
            within(-40.0, 40.0),
            within(1.0, 80.0),
            within(0.01, 0.4),
            within(0.0, 2.0),
            within(0.01, 0.4),
        );
        start += within(0.05, 1.0);
    }
    Script::parse(&text, "varied.toml").unwrap()
}

/// 1,000 frames, or 10,000 in a campaign.
#[test]
fn a_varied_stream_of_touches_accuses_no_healthy_taxel() {
    let frames = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 10_000 } else { 1_000 };
    let found = Worn::new().play(&varied(f64::from(frames) * 5.128e-3, 11), frames);
    println!("{frames} frames of varied touches: {} healthy taxels accused", found.len());
    assert!(found.is_empty(), "{found:?}");
}

/// Something flat presses every panel from the end of the tare on, with 1.2 N on each taxel.
fn all_pressed() -> Script {
    let touch = |panel: &Panel| {
        let pitch = panel.pitch_um.map(|pitch| f64::from(pitch) / 1e3);
        let (columns, rows) = (f64::from(panel.columns), f64::from(panel.rows));
        format!(
            "[[touch]]\npanel = \"{}\"\nshape = \"box\"\nsize_mm = [{:.1}, {:.1}]\nat = [{:.1}, {:.1}]\n\
             force_n = 600\nstart_s = 0.1\nrise_s = 0.05\nhold_s = 5\n",
            panel.name,
            (columns + 2.0) * pitch[0],
            (rows + 2.0) * pitch[1],
            (columns - 1.0) / 2.0,
            (rows - 1.0) / 2.0,
        )
    };
    let touches: String = Garment::reference().panels.iter().map(touch).collect();
    Script::parse(&format!("duration_s = 9\nseed = 3\n{touches}"), "pressed.toml").unwrap()
}

/// Breaks fifty taxels, spread over all panels, each in one of these ways in turn.
fn fifty(script: &mut Script, ways: &[TaxelHealth]) -> BTreeMap<usize, TaxelHealth> {
    // Steps that share no factor with 2,048.
    let taxel = |index: usize| (index * 709 + 3) % TAXELS;
    let ill = (0..50).map(|index| (taxel(index), ways[index % ways.len()]));
    for (index, (taxel, health)) in ill.clone().enumerate() {
        let taxel = taxel as u16;
        match health {
            TaxelHealth::Dead => script.faults.dead.push(taxel),
            TaxelHealth::Stuck => script.faults.stuck.push(Stuck { taxel, code: 20 + 80 * index as u16 }),
            _ => script.faults.noisy.push(Noisy { taxel, counts: 60.0 }),
        }
    }
    ill.collect()
}

/// Each is found as what it is within so many frames after all are pressed, which shows the dead ones: from frame 30 on.
fn found_soon(mut worn: Worn, ways: &[TaxelHealth], soon: u32) {
    const PRESSED: u32 = 30;
    let mut script = all_pressed();
    let expected = fifty(&mut script, ways);
    let found = worn.play(&script, 130);
    let last = found.values().map(|(frame, _)| *frame).max().unwrap_or(0);
    println!("{} of {} found, the last in frame {last}", found.len(), expected.len());
    let classes: BTreeMap<_, _> = found.into_iter().map(|(taxel, (_, health))| (taxel, health)).collect();
    assert_eq!(classes, expected);
    assert!(last <= PRESSED + soon);
}

#[test]
fn fifty_dead_stuck_and_noisy_taxels_are_found_within_100_frames() {
    found_soon(Worn::new(), &[TaxelHealth::Dead, TaxelHealth::Stuck, TaxelHealth::Noisy], 100);
}

#[test]
fn codes_of_8_bits_accuse_no_healthy_taxel_and_show_dead_and_noisy_ones() {
    found_soon(Worn::at(Depth::Eight), &[TaxelHealth::Dead, TaxelHealth::Noisy], 108);
    let found = Worn::at(Depth::Eight).play(&sim::load("five").unwrap(), 400);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn lines_that_break_or_short_are_told_apart() {
    let mut script = all_pressed();
    script.faults.from_s = 0.09;
    script.faults.open = vec![100, 1500];
    script.faults.shorted = vec![700, 2047];
    // Nothing presses beside a short circuit that is not pressed by anything.
    script.touches.retain(|touch| touch.panel == "chest" || touch.panel == "left arm");
    let found = Worn::new().play(&script, 100);
    let classes: Vec<_> = found.into_iter().map(|(taxel, (_, health))| (taxel, health)).collect();
    use TaxelHealth::{Open, Shorted};
    assert_eq!(classes, [(100, Open), (700, Shorted), (1500, Open), (2047, Shorted)]);
}

#[test]
fn no_healthy_taxel_is_accused() {
    for scene in sim::list() {
        let script = sim::load(&scene.name).unwrap();
        let ill = script.faults != Default::default();
        if ill || script.load_garment().unwrap() != Garment::reference() {
            continue;
        }
        let frames = (script.duration_s * 195.0) as u32;
        let found = Worn::new().play(&script, frames);
        assert!(found.is_empty(), "{}: {found:?}", scene.name);
        println!("{}: {frames} frames", scene.name);
    }
}

#[test]
fn every_fault_of_a_line_or_an_input_is_told_as_itself() {
    let mut rng = fastrand::Rng::with_seed(7);
    // Lines are inverted, inputs exchanged, blocks turned: the self-test does not mind.
    for garment in [Garment::reference(), Garment::mat(), rewire(&Garment::reference(), &mut rng)] {
        let mut script = all_pressed();
        script.touches.retain(|touch| garment.panels.iter().any(|panel| panel.name.as_str() == touch.panel));
        assert_eq!(examine(&garment, &script), Findings { lines: 9, inputs: 4, faults: Default::default() });
        let faults = pin_faults(&garment);
        assert_eq!(faults.len(), 8 + 18 + 12);
        for fault in faults {
            script.faults.pins = vec![fault];
            assert_eq!(examine(&garment, &script).faults, [fault], "{}", garment.name);
        }
    }
}

#[test]
fn several_faults_are_told_side_by_side() {
    let mut script = Script::parse("duration_s = 1", "rest.toml").unwrap();
    let faults = [
        (2, Fault::Bridged(12)),
        (3, Fault::StuckHigh),
        (8, Fault::StuckLow),
        (26, Fault::Supplied),
        (28, Fault::Open),
    ];
    script.faults.pins = faults.map(|(pin, fault)| PinFault { pin, fault }).to_vec();
    assert_eq!(examine(&Garment::reference(), &script).faults, script.faults.pins[..]);
}

#[test]
fn a_self_test_reports_its_findings_and_gives_every_taxel_another_chance() {
    let mut script = all_pressed();
    script.faults.stuck = vec![Stuck { taxel: 77, code: 300 }];
    let mut worn = Worn::new();
    assert_eq!(worn.play(&script, 100).len(), 1);
    let gain = |worn: &Worn| worn.board.state().condition.gain()[77];
    assert_eq!(gain(&worn), 0);
    let (mut body, mut wire) = ([0; 64], [0; 64]);
    let length = encode(&Request::SelfTest, &mut body, &mut wire).unwrap();
    worn.board.step(Micros(0), Input::Received(&wire[..length]), &mut ());
    let jobs = std::iter::from_fn(|| worn.board.step(Micros(0), Input::Tick, &mut ()));
    assert!(jobs.take(9).any(|job| job == Job::Examine));
    script.faults.pins = vec![PinFault { pin: 9, fault: Fault::Bridged(10) }];
    let findings = examine(&worn.garment, &script);
    let lost = worn.board.health().overruns;
    worn.board.step(Micros(20_480), Input::Examined(Ok(findings.clone())), &mut ());
    assert_eq!(worn.board.health().overruns - lost, 4, "of 5.12 ms each");
    assert_eq!((worn.board.health_of(77), gain(&worn)), (TaxelHealth::Good, 4096));
    let (mut told, mut receiver) = (Vec::new(), Box::new(Receiver::<8192>::new()));
    while let [byte, ..] = worn.board.pending(Micros(20_480), &mut ()) {
        if let Some(Ok(body)) = receiver.push(*byte) {
            match decode(body).unwrap() {
                (_, Report::SelfTest(report)) => told.push(Ok((report.time, report.findings))),
                (_, Report::Answer(answer)) if answer.request == 9 => {
                    told.push(Err(answer.refusal.is_none()))
                }
                (0u32.., _) => {}
            }
        }
        worn.board.sent(1);
    }
    assert_eq!(told, [Ok((Micros(20_480), findings)), Err(true)]);
    script.faults.pins.clear();
    assert_eq!(worn.play(&script, 100).keys().copied().collect::<Vec<_>>(), [77], "it is found again");
}
