//! Gains that make the taxels of a panel alike, and the panel's curve.

use super::curve::{Curve, PARTS};
use super::plates::Plate;
use super::reading::{Reading, mean};
use super::residuals::{OfWeight, Residuals, felt, of_weights};
use crate::error::{Context, Result, SettingError};
use taxel_core::condition::UNITY;
use taxel_core::garment::Layout;

/// Rounds of gains against the panel's mean, and back.
const ROUNDS: usize = 4;
/// Error of a mean over frames: counts, and share of the signal.
const STRAYS: (f64, f64) = (0.6, 0.01);
/// A taxel below this share of its plate's median counts as silent.
const SILENT: f64 = 0.2;
/// Signals below this many counts make no knot.
const FAINT: f64 = 2.0;
/// Range of a taxel's gain.
const GAINS: (f64, f64) = (0.25, 4.0);

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Gain by taxel number, Q4.12; 1 for taxels that were not measured.
    pub gains: Vec<u16>,
    /// Curve by panel; none for panels that were not measured.
    pub curves: Vec<Option<Curve>>,
    /// Silent taxels.
    pub silent: Vec<u16>,
    /// Quality of the fit.
    pub residuals: Residuals,
    /// Error at each weight, lightest first.
    pub weights: Vec<OfWeight>,
}

/// One taxel under one weight.
struct Point {
    taxel: usize,
    level: usize,
    going: bool,
    counts: f64,
}

/// Fits readings of plates.
pub fn fit(layout: &Layout, plates: &[Plate], readings: &[Reading]) -> Result<Fitted> {
    let mut gains = vec![1.0; layout.taxels()];
    let silent = silent(plates, readings);
    let mut curves = Vec::new();
    for (panel, area) in layout.areas().iter().enumerate() {
        let of = |reading: &&Reading| usize::from(plates[reading.plate].bounds.panel) == panel;
        let readings: Vec<&Reading> = readings.iter().filter(of).collect();
        let curve = match readings.is_empty() {
            true => None,
            false => Some(
                fit_panel(plates, &readings, &silent, &mut gains)
                    .with_context(|| format!("panel {}", area.name))?,
            ),
        };
        curves.push(curve);
    }
    let gains: Vec<u16> = gains.iter().map(|gain| (gain * f64::from(UNITY)).round() as u16).collect();
    let felt = felt(plates, readings, &gains, &curves, &silent);
    Ok(Fitted {
        gains,
        curves,
        silent,
        residuals: Residuals::of(readings, &felt),
        weights: of_weights(&felt),
    })
}

/// Taxels without response under the heaviest weight of their plate although others respond, and all taxels
/// of a plate without response.
fn silent(plates: &[Plate], readings: &[Reading]) -> Vec<u16> {
    let mut found = Vec::new();
    for (index, plate) in plates.iter().enumerate() {
        let of = readings.iter().filter(|reading| reading.plate == index);
        let Some(top) = of.max_by(|a, b| a.newtons.total_cmp(&b.newtons)) else {
            found.extend(&plate.taxels);
            continue;
        };
        let mut sorted = top.counts.clone();
        sorted.sort_by(f64::total_cmp);
        let median = sorted[sorted.len() / 2];
        let mute = plate.taxels.iter().zip(&top.counts).filter(|(_, counts)| **counts < SILENT * median);
        found.extend(mute.map(|(taxel, _)| *taxel));
    }
    found
}

/// Sets the gains of a panel's taxels. Returns its curve.
fn fit_panel(plates: &[Plate], readings: &[&Reading], silent: &[u16], gains: &mut [f64]) -> Result<Curve> {
    let mut levels: Vec<f64> = readings.iter().map(|reading| reading.each()).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let points = points(plates, readings, silent, &levels);
    require!(!points.is_empty(), SettingError::Calibration, "no taxel responds to the weights");
    let mut live: Vec<usize> = points.iter().map(|point| point.taxel).collect();
    live.sort_unstable();
    live.dedup();
    for _ in 0..ROUNDS {
        let means = means(&points, levels.len(), gains);
        let mut sums = vec![[0.0; 2]; gains.len()];
        for Point { taxel, level, counts, .. } in &points {
            let weight = 1.0 / (STRAYS.0.powi(2) + (STRAYS.1 * means[*level]).powi(2));
            sums[*taxel][0] += weight * means[*level] * counts;
            sums[*taxel][1] += weight * counts * counts;
        }
        for taxel in &live {
            gains[*taxel] = (sums[*taxel][0] / sums[*taxel][1]).clamp(GAINS.0, GAINS.1);
        }
        let scale = mean(live.iter().map(|taxel| gains[*taxel]));
        live.iter().for_each(|taxel| gains[*taxel] /= scale);
    }
    // The curve is fitted to the gains as rounded for the board.
    let unity = f64::from(UNITY);
    live.iter().for_each(|taxel| gains[*taxel] = (gains[*taxel] * unity).round() / unity);
    let means = means(&points, levels.len(), gains);
    let knots: Vec<[f64; 2]> =
        means.iter().zip(&levels).map(|(counts, each)| [*counts, each * 1e6]).collect();
    let loud: Vec<[f64; 2]> = knots.iter().copied().filter(|[counts, _]| *counts >= FAINT).collect();
    require!(
        !loud.is_empty(),
        SettingError::Calibration,
        "under {FAINT} counts a taxel under the heaviest weight: put on heavier ones"
    );
    let full = f64::from(u16::MAX / PARTS as u16);
    require!(
        loud.iter().all(|[counts, _]| *counts < full),
        SettingError::Calibration,
        "the weights exceed the range of the converter"
    );
    Curve::through(&loud)
}

fn points(plates: &[Plate], readings: &[&Reading], silent: &[u16], levels: &[f64]) -> Vec<Point> {
    let mut points = Vec::new();
    for reading in readings {
        let level = levels.iter().position(|level| *level == reading.each()).unwrap_or(0);
        for (taxel, counts) in plates[reading.plate].taxels.iter().zip(&reading.counts) {
            if !silent.contains(taxel) {
                let (taxel, counts, going) = (usize::from(*taxel), *counts, reading.going);
                points.push(Point { taxel, level, going, counts });
            }
        }
    }
    points
}

/// Mean counts by level, over loading and unloading.
fn means(points: &[Point], levels: usize, gains: &[f64]) -> Vec<f64> {
    let mut sums = vec![[[0.0; 2]; 2]; levels];
    for point in points {
        let [sum, count] = &mut sums[point.level][usize::from(point.going)];
        *sum += gains[point.taxel] * point.counts;
        *count += 1.0;
    }
    let both = |way: &[[f64; 2]; 2]| {
        mean(way.iter().filter(|[_, count]| *count > 0.0).map(|[sum, count]| sum / count))
    };
    sums.iter().map(both).collect()
}
