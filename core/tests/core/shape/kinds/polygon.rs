//! Even pressure within a hard edge.

use super::body::{Body, End};
use super::one_of;
use crate::shape::range;
use fastrand::Rng;
use taxel_core::shape::Class;

/// Pressure of at most 1.4.
pub fn image(body: &Body, rng: &mut Rng) -> Vec<f64> {
    let Body { length, width, .. } = *body;
    match body.class {
        Class::RECTANGLE => body.image(|u, v| f64::from(u.abs() <= length && v.abs() <= width)),
        Class::ROUND => body.image(|u, v| f64::from(u.hypot(v) <= length)),
        _ => {
            let end = one_of(&[End::Capsule, End::Blunt], rng);
            let (power, taper) = (one_of(&[0.0, 0.25, 0.5, 1.0], rng), range(rng, 0.0, 0.4));
            body.image(|u, v| {
                let left = 1.0 - body.rim(end, u, v).powi(2);
                if left > 0.0 { left.powf(power) * (1.0 + taper * u / length) } else { 0.0 }
            })
        }
    }
}
