//! A taxel's mean and spread at the knots, and how much of what it felt they explain.

use super::bend::KnotWeight;

/// KnotWeight of frames from which on a knot's mean counts.
const FEWEST: f32 = 3.0;
/// Share of a day's frames at a knot that the spread covers.
const COVERED: f32 = 0.998;

/// A taxel's course on one day: its mean at each knot; NaN where no frame was near.
pub(super) fn means(weights: &[[KnotWeight; 4]], felt: impl Iterator<Item = u16>, knots: usize) -> Vec<f32> {
    let (mut sums, mut all) = (vec![0.0; knots], vec![0.0; knots]);
    for (frame, felt) in weights.iter().zip(felt) {
        for (knot, weight) in frame.iter().filter(|(_, weight)| *weight > 0.0) {
            // Squared: what is felt between knots says little of either.
            let weight = weight * weight;
            sums[*knot] += weight * f32::from(felt);
            all[*knot] += weight;
        }
    }
    sums.iter().zip(&all).map(|(sum, all)| if *all >= FEWEST { sum / all } else { f32::NAN }).collect()
}

/// Returns the expected pressure in a frame.
pub(super) fn expected(means: &[f32], frame: &[KnotWeight; 4]) -> f32 {
    let there = frame.iter().filter(|(knot, weight)| *weight > 0.0 && means[*knot].is_finite());
    let (sum, all) =
        there.fold((0.0, 0.0), |(sum, all), (knot, weight)| (sum + weight * means[*knot], all + weight));
    if all > 0.0 { sum / all } else { 0.0 }
}

/// Sum of the squares of what the means leave unexplained.
pub(super) fn unexplained(
    weights: &[[KnotWeight; 4]],
    felt: impl Iterator<Item = u16>,
    means: &[f32],
) -> f64 {
    weights
        .iter()
        .zip(felt)
        .map(|(frame, felt)| f64::from(f32::from(felt) - expected(means, frame)).powi(2))
        .sum()
}

/// Distances from the day's own mean at each knot that nearly all its frames keep.
pub(super) fn spreads(
    weights: &[[KnotWeight; 4]],
    felt: impl Iterator<Item = u16>,
    means: &[f32],
) -> Vec<f32> {
    let mut off: Vec<Vec<f32>> = vec![Vec::new(); means.len()];
    for (frame, felt) in weights.iter().zip(felt) {
        let distance = (f32::from(felt) - expected(means, frame)).abs();
        // Every knot beside a frame is in doubt by it.
        frame.iter().filter(|(_, weight)| *weight > 0.1).for_each(|(knot, _)| off[*knot].push(distance));
    }
    let covering = |distances: &mut Vec<f32>| {
        distances.sort_by(f32::total_cmp);
        let at = (distances.len() as f32 * COVERED) as usize;
        distances.get(at.min(distances.len().saturating_sub(1))).copied().unwrap_or(0.0)
    };
    off.iter_mut().map(covering).collect()
}
