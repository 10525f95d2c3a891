//! Ill taxels on the simulated board: each is found, and told as what it is; no other is.

use std::collections::BTreeMap;
use taxel::sim::{self, Noisy, PINS, Script, SimBoard, Stuck};
use taxel_core::acquire::{Acquire, MuxScan};
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Panel, Pins};
use taxel_core::health::TaxelHealth;
use taxel_core::run::block_on;
use taxel_core::scene::Scene;
use taxel_core::wire::{Request, encode};

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
        let info = BoardInfo { firmware: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
        let garment = Garment::reference();
        let board = Box::new(Board::new(info, garment.clone(), Scene::shipped()).unwrap());
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
            let scanned = block_on(scan.scan(&circuit, &Scene::shipped().plan)).unwrap();
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

#[test]
fn fifty_dead_stuck_and_noisy_taxels_are_found_within_100_frames() {
    let mut script = all_pressed();
    let mut expected = BTreeMap::new();
    // Steps that share no factor with 2,048 spread them over all panels.
    for index in 0..50usize {
        let taxel = (index * 709 + 3) % TAXELS;
        let number = taxel as u16;
        let health = match index % 3 {
            0 => {
                script.faults.dead.push(number);
                TaxelHealth::Dead
            }
            1 => {
                script.faults.stuck.push(Stuck { taxel: number, code: 20 + 80 * index as u16 });
                TaxelHealth::Stuck
            }
            _ => {
                script.faults.noisy.push(Noisy { taxel: number, counts: 60.0 });
                TaxelHealth::Noisy
            }
        };
        expected.insert(taxel, health);
    }
    let found = Worn::new().play(&script, 130);
    let last = found.values().map(|(frame, _)| *frame).max().unwrap_or(0);
    println!("{} of {} found, the last in frame {last}", found.len(), expected.len());
    // All are pressed from frame 30 on.
    assert!(last <= 130);
    let classes: BTreeMap<_, _> = found.into_iter().map(|(taxel, (_, health))| (taxel, health)).collect();
    assert_eq!(classes, expected);
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
