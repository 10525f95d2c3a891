//! Bodies on an elastic half space: pressure goes as a power of what is left of the squared distance to the
//! rim.

use super::body::{Body, End};
use super::one_of;
use crate::shape::range;
use fastrand::Rng;
use taxel_core::shape::Class;

/// The power is 1/2 for a ball (Hertz), 0 for what is pressed evenly, below for a flat punch, which presses
/// most at its rim.
pub fn image(body: &Body, rng: &mut Rng) -> Vec<f64> {
    let Body { length, width, .. } = *body;
    let fall = |left: f64, power: f64| match left {
        // Where a punch presses without limit, its edge gives way.
        ..=0.0 => 0.0,
        _ if power < 0.0 => left.max(0.06).powf(power),
        _ => left.powf(power),
    };
    match body.class {
        Class::RECTANGLE => {
            let power = range(rng, -0.2, 0.3);
            body.image(|u, v| {
                fall(1.0 - (u / length).powi(2), power) * fall(1.0 - (v / width).powi(2), power)
            })
        }
        Class::ROUND => {
            let power = range(rng, -0.2, 0.5);
            body.image(|u, v| fall(1.0 - (u * u + v * v) / (length * length), power))
        }
        _ => {
            let (power, end) = (range(rng, 0.0, 0.8), one_of(&[End::Capsule, End::Blunt], rng));
            body.image(|u, v| fall(1.0 - body.rim(end, u, v).powi(2), power))
        }
    }
}
