//! Shapes: what is recognised, by generators of touches.

mod base;
mod built_in;
mod drawn;
mod kinds;
mod rig;

use fastrand::Rng;

/// A number between two, evenly distributed.
fn range(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}
