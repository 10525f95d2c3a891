//! An imperfect garment: taxels of unequal gain and rest, noise with memory, slow drift, crosstalk between
//! neighbours.

use fastrand::Rng;
use taxel_core::garment::{Garment, Layout};

const COUNTS_PER_NEWTON: f64 = 1000.0;
const FULL: f64 = 4095.0;

/// The taxels of a garment.
pub struct Skin {
    rest: Vec<f64>,
    gain: Vec<f64>,
    hum: Vec<f64>,
    rms: f64,
    rng: Rng,
    /// First taxel, columns, rows and pitch (mm) of each panel.
    pub panels: Vec<(usize, usize, usize, [f64; 2])>,
}

impl Skin {
    /// A garment with random imperfections.
    pub fn new(garment: &Garment, mut rng: Rng) -> Skin {
        let layout = Layout::build(garment, 2048, 4095).expect("a preset is good");
        let mut first = 0;
        let panels = garment.panels.iter().map(|panel| {
            let (columns, rows) = (usize::from(panel.columns), usize::from(panel.rows));
            first += columns * rows;
            (first - columns * rows, columns, rows, panel.pitch_um.map(|um| f64::from(um) / 1e3))
        });
        let panels = panels.collect();
        let count = layout.taxels();
        let rest = 40.0 + 120.0 * rng.f64();
        Skin {
            rest: (0..count).map(|_| rest + 25.0 * rng.f64()).collect(),
            gain: (0..count).map(|_| 0.9 + 0.2 * rng.f64()).collect(),
            hum: vec![0.0; count],
            rms: 2.0 + 3.0 * rng.f64(),
            rng,
            panels,
        }
    }

    /// Codes of taxels under these forces in newtons.
    pub fn codes(&mut self, newtons: &[f64], codes: &mut [u16]) {
        for (taxel, code) in codes.iter_mut().enumerate().take(self.rest.len()) {
            // Uniform numbers with a standard deviation of 1, half of which persists from scan to scan.
            self.hum[taxel] = 0.5 * self.hum[taxel] + 0.87 * 3.46 * (self.rng.f64() - 0.5);
            let beside = newtons[taxel.saturating_sub(1)] + newtons.get(taxel + 1).copied().unwrap_or(0.0);
            let force = 0.98 * newtons[taxel] + 0.01 * beside;
            let signal =
                self.rest[taxel] + self.gain[taxel] * COUNTS_PER_NEWTON * force + self.rms * self.hum[taxel];
            *code = signal.round().clamp(0.0, FULL) as u16;
            self.rest[taxel] += 0.002 * (self.rng.f64() - 0.5);
        }
    }
}
