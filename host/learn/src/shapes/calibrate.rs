//! Sets the confidence of votes and the limit for "none", from examples left out of training.

use super::data::Example;
use taxel::files::bases::BoardGallery;
use taxel::learn::shapes::confidence::count;
use taxel_core::shape::{ConfidenceTable, Recognised, STEPS};

/// Multiple of the distance of nearly all left-out examples beyond which a touch is "none".
const BEYOND: f64 = 1.5;
/// Share of the left-out examples within that distance.
const NEARLY_ALL: f64 = 0.99;

/// Completes a gallery by the results of galleries that were tested on left-out examples.
pub fn calibrate(gallery: &mut BoardGallery, examples: &[&Example], found: &[Recognised]) {
    let mut distances: Vec<u16> = found.iter().map(|found| found.distance).collect();
    distances.sort();
    let at = |part: f64| distances.get((part * (distances.len() - 1) as f64) as usize).copied().unwrap_or(0);
    gallery.reject = (f64::from(at(NEARLY_ALL)) * BEYOND).clamp(1.0, 65_535.0) as u16;
    gallery.confidence = ConfidenceTable {
        // One of several voters, most of them, all of them.
        shares: [16_384, 24_576, 32_767],
        distances: [at(0.25), at(0.5), at(0.75)],
        right: [[0; STEPS]; STEPS],
    };
    let right =
        |(found, example): (&Recognised, &&Example)| found.class.map(usize::from) == Some(example.class);
    let hits: Vec<bool> = found.iter().zip(examples).map(right).collect();
    let mean = hits.iter().filter(|hit| **hit).count() as f64 / hits.len().max(1) as f64;
    count(&mut gallery.confidence, found, &hits, mean);
}
