//! Errors of a calibration at the weights that it was made with.

use super::curve::{Curve, PARTS};
use super::plates::Plate;
use super::reading::{Reading, mean};
use serde::{Deserialize, Serialize};
use taxel_core::condition::UNITY;

/// Quality of a calibration, as shares of 1 except for the last.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Residuals {
    /// Error of the forces, rms over all weights, loading and unloading.
    pub error: f64,
    /// Greatest error.
    pub worst: f64,
    /// Largest difference between loading and unloading at the same weight.
    pub hysteresis: f64,
    /// Noise of one taxel in one frame under the heaviest weight, rms.
    pub noise: f64,
    /// Noise of one taxel in one frame at rest, rms, counts.
    #[serde(default)]
    pub rest: f64,
}

/// Error at one weight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfWeight {
    /// The weight, N.
    pub newtons: f64,
    /// Value while loading, N, mean over the plates.
    pub coming: f64,
    /// Value while unloading, N; none for the heaviest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub going: Option<f64>,
    /// Error of both, rms over the plates, as a share of the weight.
    pub error: f64,
}

/// A reading, and its force by the calibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Felt {
    newtons: f64,
    going: bool,
    felt: f64,
}

impl Felt {
    fn error(&self) -> f64 {
        self.felt / self.newtons - 1.0
    }
}

impl Residuals {
    /// Errors of a fit to readings.
    pub(super) fn of(readings: &[Reading], felt: &[Felt]) -> Residuals {
        Residuals {
            error: rms(felt.iter().map(Felt::error)),
            worst: felt.iter().fold(0.0, |worst, felt| felt.error().abs().max(worst)),
            hysteresis: hysteresis(readings),
            noise: noise(readings),
            rest: 0.0,
        }
    }
}

/// Forces of all readings by the calibration.
pub(super) fn felt(
    plates: &[Plate],
    readings: &[Reading],
    gains: &[u16],
    curves: &[Option<Curve>],
    silent: &[u16],
) -> Vec<Felt> {
    let one = |reading: &Reading| {
        let plate = &plates[reading.plate];
        let curve = curves[usize::from(plate.bounds.panel)].as_ref()?;
        let felt = force(reading, plate, gains, curve, silent);
        Some(Felt { newtons: reading.newtons, going: reading.going, felt })
    };
    readings.iter().filter_map(one).collect()
}

/// Errors by weight, lightest first.
pub(super) fn of_weights(all: &[Felt]) -> Vec<OfWeight> {
    let mut weights: Vec<f64> = all.iter().map(|felt| felt.newtons).collect();
    weights.sort_by(f64::total_cmp);
    weights.dedup();
    let of = |newtons: f64| {
        let these = all.iter().filter(move |felt| felt.newtons == newtons);
        let way = |going: bool| these.clone().filter(move |felt| felt.going == going).map(|felt| felt.felt);
        OfWeight {
            newtons,
            coming: mean(way(false)),
            going: way(true).next().map(|_| mean(way(true))),
            error: rms(these.clone().map(Felt::error)),
        }
    };
    weights.into_iter().map(of).collect()
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    mean(values.map(|value| value * value)).sqrt()
}

/// Force of a reading by the calibration, N; silent taxels count as the mean of the others.
fn force(reading: &Reading, plate: &Plate, gains: &[u16], curve: &Curve, silent: &[u16]) -> f64 {
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
    rms(parts.map(|(noise, counts)| noise / counts))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_weight_has_its_own_error() {
        let felt = |newtons, going, felt| Felt { newtons, going, felt };
        let all = [felt(5.0, false, 4.9), felt(10.0, false, 10.0), felt(5.0, true, 5.1)];
        let weights = of_weights(&all);
        assert_eq!(weights.len(), 2);
        assert_eq!((weights[0].coming, weights[0].going), (4.9, Some(5.1)));
        assert!((weights[0].error - 0.02).abs() < 1e-9);
        assert_eq!(weights[1], OfWeight { newtons: 10.0, coming: 10.0, going: None, error: 0.0 });
    }
}
