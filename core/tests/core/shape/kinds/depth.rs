//! Rigid bodies with a rounded edge, tilted, in foam that answers to the depth alone.

use super::body::{Body, End};
use super::one_of;
use crate::shape::range;
use fastrand::Rng;
use taxel_core::shape::Class;

/// Pressure of the foam, which is stiffer the deeper it is pressed.
pub fn image(body: &Body, rng: &mut Rng) -> Vec<f64> {
    let Body { length, width, .. } = *body;
    let tilt = [range(rng, -0.3, 0.3), range(rng, -0.3, 0.3)];
    let stiffening = range(rng, 1.0, 1.5);
    let answer = |depth: f64| depth.max(0.0).powf(stiffening);
    if body.class == Class::FINGER {
        let (end, bulge) = (one_of(&[End::Capsule, End::Blunt], rng), range(rng, 0.4, 1.0));
        return body.image(|u, v| {
            let rim = body.rim(end, u, v);
            let rise = bulge * (1.0 - (1.0 - rim * rim).max(0.0).sqrt());
            if rim < 1.0 { answer(1.0 - rise + tilt[0] * u / length) } else { 0.0 }
        });
    }
    let edge = width * range(rng, 0.05, 0.3);
    let depth = edge * range(rng, 1.0, 2.5);
    body.image(|u, v| {
        // Distance beyond the flat part.
        let out = match body.class {
            Class::ROUND => u.hypot(v) - (length - edge),
            _ => (u.abs() - (length - edge)).max(v.abs() - (width - edge)),
        };
        let out = out.max(0.0);
        let rise = edge - (edge * edge - out * out).max(0.0).sqrt();
        let lean = tilt[0] * u / length + tilt[1] * v / width;
        if out < edge { answer(1.0 - rise / depth + lean) } else { 0.0 }
    })
}
