//! A simulated board, observed for the taxels that it considers faulty.

use std::collections::{BTreeMap, BTreeSet};
use taxel::sim::{PINS, Script, SimBoard};
use taxel_core::acquire::{Acquire, Depth, MuxScan, Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped};
pub use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::health::TaxelHealth;
use taxel_core::run::block_on;
use taxel_core::scene::Scene;
use taxel_core::wire::{Request, encode};

/// Frames averaged by the tare.
pub const TARE: u16 = 16;
/// Duration of a scan of the simulated board.
pub const FRAME_S: f64 = 5.128e-3;

/// A simulated board and its findings.
pub struct WatchedBoard {
    pub garment: Garment,
    pub board: Box<Shipped>,
    /// Intentions announced so far.
    pub said: BTreeSet<&'static str>,
}

impl WatchedBoard {
    pub fn new() -> WatchedBoard {
        WatchedBoard::at(Depth::Twelve)
    }

    /// A board with codes of this depth.
    pub fn at(depth: Depth) -> WatchedBoard {
        let mut scene = Scene::shipped();
        scene.plan.depth = depth;
        let info = BoardInfo {
            firmware: "",
            chip: "",
            pins: Pins::ANY,
            full_scale: 4095,
            link_bytes_per_s: 1_000_000,
        };
        let garment = Garment::reference();
        let board = Box::new(Shipped::new(info, garment.clone(), scene).unwrap());
        WatchedBoard { garment, board, said: BTreeSet::new() }
    }

    /// Plays this many frames of a script after a tare. Returns the faulty taxels with the frame of the
    /// finding and the class.
    pub fn play(&mut self, script: &Script, frames: u32) -> BTreeMap<usize, (u32, TaxelHealth)> {
        self.play_shaken(script, frames, 0.0)
    }

    /// Plays with noise on every signal beyond the first frame, as a share of it, rms.
    pub fn play_shaken(
        &mut self,
        script: &Script,
        frames: u32,
        part: f64,
    ) -> BTreeMap<usize, (u32, TaxelHealth)> {
        let SimBoard { mut lines, delay, adc, clock, .. } =
            SimBoard::new(&self.garment, script, script.seed).unwrap();
        let mut scan = MuxScan::<_, _, _, _, PINS, TAXELS>::new(&mut lines, delay, adc, clock);
        self.tare();
        let mut found = BTreeMap::new();
        let (mut rng, mut rest) = (fastrand::Rng::with_seed(script.seed), Vec::new());
        for frame in 0..u32::from(TARE) + frames {
            let circuit = self.board.circuit().clone();
            let Scan { codes, report } =
                block_on(scan.scan(&circuit, &self.board.setup().scene.plan)).unwrap();
            let mut codes = codes.to_vec();
            if rest.is_empty() {
                rest.clone_from(&codes);
            }
            if part > 0.0 {
                // Four uniform numbers have a variance of a third.
                let mut normal = || (0..4).map(|_| rng.f64() - 0.5).sum::<f64>() * 3f64.sqrt();
                for (code, rest) in codes.iter_mut().zip(&rest) {
                    let signal = f64::from(code.0) - f64::from(rest.0);
                    code.0 = (f64::from(code.0) + part * signal * normal()).round().clamp(0.0, 4095.0) as u16;
                }
            }
            self.take(Scan { codes: &codes, report });
            self.note(frame, &mut found);
        }
        found
    }

    /// Requests a tare, which begins with the next frame.
    pub fn tare(&mut self) {
        let mut wire = [0; 64];
        let frame = encode(&Request::Tare { frames: TARE }, &mut wire).unwrap();
        self.board.step(Micros(0), Input::Received(frame), &mut ());
    }

    /// Shows this many frames of codes, some time after the last ones. Returns the faulty taxels with the
    /// frame of the finding.
    pub fn show(
        &mut self,
        frames: u32,
        mut codes: impl FnMut(u32) -> Vec<Code>,
    ) -> BTreeMap<usize, (u32, TaxelHealth)> {
        let (mut found, before) = (BTreeMap::new(), self.board.health().scans);
        for frame in 0..frames {
            let start = Micros(u64::from(before + frame) * 5_120);
            let report = ScanReport { start, duration_us: 5_120, ..ScanReport::default() };
            self.take(Scan { codes: &codes(frame), report });
            self.note(frame, &mut found);
        }
        found
    }

    fn take(&mut self, scan: Scan<'_>) {
        let now = Micros(scan.report.start.0 + 5_000);
        self.board.step(now, Input::Scanned(Ok(scan)), &mut ());
        self.said.insert(self.board.state().intent().leading().as_str());
    }

    fn note(&self, frame: u32, found: &mut BTreeMap<usize, (u32, TaxelHealth)>) {
        for taxel in 0..TAXELS {
            let health = self.board.health_of(taxel);
            if health != TaxelHealth::Good {
                found.entry(taxel).or_insert((frame, health));
            }
        }
    }
}
