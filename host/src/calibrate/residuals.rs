//! How well a calibration gives back the weights that it was made with.

use super::curve::{Curve, PARTS};
use super::plates::Plate;
use super::reading::Reading;
use super::steady::mean;
use serde::{Deserialize, Serialize};
use taxel_core::condition::UNITY;

/// Parts of 1.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Residuals {
    /// Error of the forces, rms over all weights, coming and going.
    pub error: f64,
    /// The greatest of them.
    pub worst: f64,
    /// Most that going differs from coming under the same weight.
    pub hysteresis: f64,
    /// Noise of one taxel in one frame under the heaviest weight, rms.
    pub noise: f64,
}

impl Residuals {
    /// Of what was fitted to readings.
    pub(super) fn of(
        plates: &[Plate],
        readings: &[Reading],
        gains: &[u16],
        curves: &[Option<Curve>],
        silent: &[u16],
    ) -> Residuals {
        let errors: Vec<f64> = readings
            .iter()
            .filter_map(|reading| {
                let plate = &plates[reading.plate];
                let curve = curves[usize::from(plate.bounds.panel)].as_ref()?;
                Some(felt(reading, plate, gains, curve, silent) / reading.newtons - 1.0)
            })
            .collect();
        Residuals {
            error: mean(errors.iter().map(|error| error * error)).sqrt(),
            worst: errors.iter().fold(0.0, |worst, error| error.abs().max(worst)),
            hysteresis: hysteresis(readings),
            noise: noise(readings),
        }
    }
}

/// Force of a reading by the calibration, N; a silent taxel counts as the mean of the others.
fn felt(reading: &Reading, plate: &Plate, gains: &[u16], curve: &Curve, silent: &[u16]) -> f64 {
    let live = plate.taxels.iter().zip(&reading.counts).filter(|(taxel, _)| !silent.contains(taxel));
    let forces = live.map(|(taxel, counts)| {
        let even = counts.max(0.0) * f64::from(gains[usize::from(*taxel)]) / f64::from(UNITY);
        curve.micronewtons((even * f64::from(PARTS)).round() as u32) as f64 / 1e6
    });
    mean(forces) * plate.taxels.len() as f64
}

fn hysteresis(readings: &[Reading]) -> f64 {
    let mut most = 0.0f64;
    for coming in readings.iter().filter(|reading| !reading.going) {
        let same = |r: &&Reading| r.going && (r.plate, r.newtons) == (coming.plate, coming.newtons);
        if let Some(going) = readings.iter().find(same) {
            let [a, b] = [coming, going].map(|reading| mean(reading.counts.iter().copied()));
            most = most.max((b - a).abs() * 2.0 / (a + b));
        }
    }
    most
}

fn noise(readings: &[Reading]) -> f64 {
    let heaviest = readings.iter().map(Reading::each).fold(0.0, f64::max);
    let top = readings.iter().filter(|reading| reading.each() == heaviest);
    let parts = top.flat_map(|r| r.noise.iter().zip(&r.counts)).filter(|(_, counts)| **counts > 0.0);
    mean(parts.map(|(noise, counts)| (noise / counts).powi(2))).sqrt()
}
