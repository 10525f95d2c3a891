//! Rigid bodies with a rounded edge, tilted, in foam that answers to the depth alone.

use super::{Frame, finger, sides};
use crate::drawn::Rng;
use taxel_core::shape::Class;

/// Foam is stiffer the deeper it is pressed.
const STIFFENING: f64 = 1.15;

/// Pressure of the foam.
pub fn image(class: Class, [rows, columns]: [u16; 2], rng: &mut Rng) -> Vec<f64> {
    let frame = Frame::random(rows, columns, rng);
    let size = frame.size;
    let tilt = [rng.range(-0.2, 0.2), rng.range(-0.2, 0.2)];
    let answer = |depth: f64| depth.max(0.0).powf(STIFFENING);
    if class == Class::FINGER {
        // A cylinder with round ends, lying.
        let [length, half] = finger(size, rows, rng);
        let (axis, radius) = (length - half, half * rng.range(1.03, 1.6));
        let bottom = radius - (radius * radius - half * half).sqrt();
        return frame.image(rows, columns, |u, v| {
            let off = (u.abs() - axis).max(0.0).hypot(v);
            let rise = radius - (radius * radius - off * off).max(0.0).sqrt();
            if off < radius { answer(1.0 - rise / bottom + tilt[0] * u / length) } else { 0.0 }
        });
    }
    let edge = size * rng.range(0.1, 0.5) * if class == Class::RECTANGLE { 0.7 } else { 1.0 };
    let depth = edge * rng.range(0.7, 2.0);
    let [length, width] = sides(size, rng);
    frame.image(rows, columns, |u, v| {
        // Distance beyond the flat part.
        let out = match class {
            Class::ROUND => (u.hypot(v) - (size - edge)).max(0.0),
            _ => (u.abs() - (length - edge)).max(0.0).hypot((v.abs() - (width - edge)).max(0.0)),
        };
        let rise = edge - (edge * edge - out * out).max(0.0).sqrt();
        let lean = (tilt[0] * u + tilt[1] * v) / size;
        if out < edge { answer(1.0 - rise / depth + lean) } else { 0.0 }
    })
}
