//! Discs, rectangles and fingers, drawn at random.
#![allow(dead_code)] // each test that uses this takes a part of it

use crate::random::Noise;
use taxel_core::format::Code;
use taxel_core::shape::Class;

/// The drawn classes.
pub const CLASSES: [Class; 3] = [Class::RECTANGLE, Class::ROUND, Class::FINGER];

/// A drawn touch; lengths in taxels.
pub struct DrawnTouch {
    class: Class,
    /// Centre.
    pub x: f64,
    pub y: f64,
    angle: f64,
    pub size: f64,
    /// Length to width of a rectangle; half width to `size` of a finger.
    ratio: f64,
    pub gain: f64,
}

impl DrawnTouch {
    /// A random touch of a class near the middle of a panel.
    pub fn random(class: Class, rows: u16, columns: u16, noise: &mut Noise) -> DrawnTouch {
        let (low, high) = match rows.min(columns) {
            ..=4 => (1.2, 1.6),
            5..=16 => (2.2, 3.6),
            _ => (4.0, 8.0),
        };
        DrawnTouch {
            class,
            x: f64::from(columns - 1) / 2.0 + noise.range(-0.5, 0.5),
            y: f64::from(rows - 1) / 2.0 + noise.range(-0.5, 0.5),
            angle: if rows <= 4 { noise.range(-0.15, 0.15) } else { noise.range(0.0, std::f64::consts::PI) },
            size: noise.range(low, high),
            ratio: if class == Class::FINGER { noise.range(0.5, 0.68) } else { noise.range(1.0, 1.7) },
            gain: noise.range(0.2, 0.9),
        }
    }

    /// Relative pressure at a point, 0 to 1.
    fn at(&self, x: f64, y: f64) -> f64 {
        let ((s, c), x, y) = (self.angle.sin_cos(), x - self.x, y - self.y);
        let (u, v) = (x * c + y * s, y * c - x * s);
        match self.class {
            Class::ROUND => f64::from(u.hypot(v) <= self.size),
            Class::RECTANGLE => {
                let (length, width) =
                    (self.size * 0.9 * self.ratio.sqrt(), self.size * 0.9 / self.ratio.sqrt());
                f64::from(u.abs() <= length && v.abs() <= width)
            }
            // A capsule, softer towards the rim.
            _ => {
                let half = self.size * self.ratio;
                let along = (u.abs() - (self.size * 1.25 - half).max(0.3)).max(0.0);
                (1.0 - (along.hypot(v) / half).powi(2)).max(0.0).powf(0.3)
            }
        }
    }

    /// Codes of a 12-bit converter: each taxel is the mean of 6 x 6 points.
    pub fn codes(&self, rows: u16, columns: u16) -> Vec<Code> {
        let taxel = |row: u16, column: u16| {
            let point = |i: i32| (f64::from(i) + 0.5) / 6.0 - 0.5;
            let at = |i: i32| self.at(f64::from(column) + point(i % 6), f64::from(row) + point(i / 6));
            Code(((0..36).map(at).sum::<f64>() / 36.0 * self.gain * 4095.0).round() as u16)
        };
        (0..rows).flat_map(|row| (0..columns).map(move |column| taxel(row, column))).collect()
    }
}
