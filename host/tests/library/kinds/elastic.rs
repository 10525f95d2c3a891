//! Bodies on an elastic layer: pressure falls off towards the rim as a power of the distance that is left.

use super::{Frame, finger, sides};
use crate::drawn::Rng;
use taxel_core::shape::Class;

/// Pressure of 1 at most. The power is 1/2 for a ball (Hertz), near 0 for a body that is flat.
pub fn image(class: Class, [rows, columns]: [u16; 2], rng: &mut Rng) -> Vec<f64> {
    let frame = Frame::random(rows, columns, rng);
    let size = frame.size;
    let fall = |left: f64, power: f64| if left > 0.0 { left.powf(power) } else { 0.0 };
    match class {
        Class::ROUND => {
            let power = rng.range(0.02, 0.4);
            frame.image(rows, columns, |u, v| fall(1.0 - (u * u + v * v) / (size * size), power))
        }
        Class::RECTANGLE => {
            let (power, [length, width]) = (rng.range(0.02, 0.3), sides(size, rng));
            frame.image(rows, columns, |u, v| {
                fall(1.0 - (u / length).powi(2), power) * fall(1.0 - (v / width).powi(2), power)
            })
        }
        // From an ellipse to nearly a rectangle with round ends.
        _ => {
            let (power, ends) = (rng.range(0.35, 0.7), rng.range(2.0, 4.0));
            let [length, width] = finger(size, rows, rng);
            frame.image(rows, columns, |u, v| {
                fall(1.0 - (u.abs() / length).powf(ends) - (v / width).powi(2), power)
            })
        }
    }
}
