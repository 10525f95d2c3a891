//! The settling time found on a simulated garment, against the exact requirement of its lines.

use anyhow::Result;
use taxel::files::scripts;
use taxel::sim::{PINS, SimBoard, Timing};
use taxel_cli::commands::garment::calibrate::settle::{Scanner, settle};
use taxel_core::acquire::{Acquire, MuxScan, Plan};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::run::block_on;

/// Capacitance of a line, pF.
const LINE_PF: f64 = 80.0;
/// Allowed residue of a full-scale step, counts.
const ERROR: f64 = 4.0;
/// Two objects on two panels.
const THINGS: &str = r#"
duration_s = 10000
[[touch]]
panel = "chest"
shape = "box"
force_n = 60
at = [6, 12]
size_mm = [60, 60]
start_s = 0
rise_s = 0.1
hold_s = 9999
fall_s = 0.1
[[touch]]
panel = "back"
shape = "box"
force_n = 60
at = [9, 20]
size_mm = [50, 70]
start_s = 0
rise_s = 0.1
hold_s = 9999
fall_s = 0.1
"#;

/// A board whose lines are charged through a resistance.
struct Lines {
    source_kohm: f64,
    timing: Timing,
    script: String,
    now_us: u64,
}

impl Scanner for Lines {
    fn scan(&mut self, settle_ns: u32, frames: u32) -> Result<Vec<f64>> {
        let mut garment = Garment::reference();
        garment.wiring.settle_ns = settle_ns;
        let wiring = format!("[wiring]\nsource_kohm = {}\nline_pf = {LINE_PF}\n", self.source_kohm);
        let script = scripts::parse(&(self.script.clone() + &wiring), "things.toml")?;
        let SimBoard { mut lines, delay, adc, clock, .. } =
            SimBoard::with_timing(&garment, &script, script.seed, self.timing)?;
        clock.advance_to(self.now_us);
        let layout = Layout::build(&garment, 2048, 4095)?;
        let circuit = Circuit::build(&garment, &layout, Pins::ANY)?;
        let mut scan = MuxScan::<_, _, _, _, PINS, 2048>::new(&mut lines, delay, adc, &clock);
        let mut sums = vec![0.0; 2048];
        for _ in 0..frames {
            let codes = block_on(scan.scan(&circuit, &Plan::default())).unwrap().codes;
            sums.iter_mut().zip(codes).for_each(|(sum, code)| *sum += f64::from(code.0) / f64::from(frames));
        }
        self.now_us = clock.now_ns() / 1000;
        Ok(sums)
    }
}

/// Time after which a line has this residue of a full-scale step, ns; the time constant is kOhm times pF.
fn need_ns(source_kohm: f64) -> f64 {
    source_kohm * LINE_PF * (4095.0 / ERROR).ln()
}

/// Least number of whole slots, ns.
fn slots(need_ns: f64) -> f64 {
    (need_ns / 2_000.0).ceil().max(1.0) * 2_000.0
}

#[test]
fn the_settling_is_that_of_the_line() {
    for source_kohm in [1.0, 3.0, 10.0, 30.0, 100.0] {
        let mut lines = Lines { source_kohm, timing: Timing::LOOP, script: THINGS.into(), now_us: 1_000_000 };
        let settled = settle(&mut lines, &Garment::reference(), ERROR).unwrap();
        let off = f64::from(settled.settle_ns) / need_ns(source_kohm) - 1.0;
        println!("{source_kohm} kOhm: {} ns, {:+.1} %; {settled:?}", settled.settle_ns, 100.0 * off);
        assert!(off.abs() <= 0.2, "{source_kohm} kOhm: {settled:?}, needed {:.0} ns", need_ns(source_kohm));
        assert_eq!(settled.unmeasured, [28, 29]);
    }
}

#[test]
fn a_board_with_slots_gets_the_least_slots_that_do() {
    for source_kohm in [1.0, 7.0, 30.0, 100.0] {
        let timing = Timing::REFERENCE;
        let mut lines = Lines { source_kohm, timing, script: THINGS.into(), now_us: 1_000_000 };
        let settled = settle(&mut lines, &Garment::reference(), ERROR).unwrap();
        // If the least number of slots is within 5 % of the requirement, noise may require another.
        let (taken, need) = (f64::from(timing.settling_ns(settled.settle_ns)), need_ns(source_kohm));
        let (least, most) = (slots(need), slots(1.05 * need));
        assert!(
            (least..=most).contains(&taken),
            "{source_kohm} kOhm: {taken} ns, needed {need}; {settled:?}"
        );
    }
}

#[test]
fn without_an_edge_nothing_is_claimed() {
    let idle = "duration_s = 10\n[idle]\nspread_counts = 2\n";
    let mut lines = Lines { source_kohm: 10.0, timing: Timing::LOOP, script: idle.into(), now_us: 1_000_000 };
    let why = settle(&mut lines, &Garment::reference(), ERROR).unwrap_err().to_string();
    assert!(why.starts_with("not sure: the picture has too few edges") && why.contains("GP26"), "{why}");
}

/// A board with lines that never settle; it refuses settling times beyond its watchdog's limit.
struct Never(u32);

impl Scanner for Never {
    fn scan(&mut self, settle_ns: u32, _: u32) -> Result<Vec<f64>> {
        anyhow::ensure!(settle_ns <= self.0, "the board refuses {settle_ns} ns");
        let edges = (0..2048).map(|taxel| if taxel % 16 < 8 { 0.0 } else { f64::from(settle_ns) / 1000.0 });
        Ok(edges.collect())
    }
}

#[test]
fn no_settling_is_tried_that_the_board_refuses() {
    let why = settle(&mut Never(800_000), &Garment::reference(), ERROR).unwrap_err().to_string();
    assert!(why.starts_with("not sure: the codes have not settled after 800 us"), "{why}");
    assert!(why.ends_with("at most 800 us of settling for this garment"), "{why}");
}

/// A board whose lines settle in 20 us, with a noisy converter.
struct Noisy {
    random: fastrand::Rng,
}

impl Scanner for Noisy {
    fn scan(&mut self, settle_ns: u32, frames: u32) -> Result<Vec<f64>> {
        let left = (-f64::from(settle_ns) / 3_000.0).exp();
        let rms = 3.0 / f64::from(frames).sqrt();
        let code = |taxel: usize| if taxel % 16 < 8 { 0.0 } else { 700.0 };
        let mut noise = || rms * ((0..12).map(|_| self.random.f64()).sum::<f64>() - 6.0);
        let codes = (0..2048usize).map(|taxel| {
            let before = code(taxel.wrapping_sub(1) % 16);
            code(taxel) + left * (before - code(taxel)) + noise()
        });
        Ok(codes.collect())
    }
}

/// One search in three took noise for a residue of a settled scan, and one in a hundred gave up.
#[test]
fn noise_does_not_make_a_settled_board_slower() {
    for seed in 0..300 {
        let mut board = Noisy { random: fastrand::Rng::with_seed(seed) };
        let settled = settle(&mut board, &Garment::reference(), ERROR).unwrap();
        assert_eq!(settled.slow_ns, 200_000, "seed {seed}: {settled:?}");
    }
}
