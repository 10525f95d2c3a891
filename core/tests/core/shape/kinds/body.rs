//! The outline of a rectangle, a disc or a finger, and its place on a panel.

use super::one_of;
use crate::shape::range;
use fastrand::Rng;
use std::f64::consts::{FRAC_PI_2, PI};
use taxel_core::shape::Class;

/// The outline of a body; lengths in taxels.
pub struct Body {
    pub class: Class,
    pub rows: u16,
    pub columns: u16,
    x: f64,
    y: f64,
    angle: f64,
    /// Half of its length.
    pub length: f64,
    /// Half of its width.
    pub width: f64,
}

/// Ends of a finger. An ellipse is a shape of its own, and no finger.
#[derive(Debug, Clone, Copy)]
pub enum End {
    /// Half discs.
    Capsule,
    /// A superellipse of the third power: between an ellipse and a rectangle.
    Blunt,
}

/// Part of a body that may lie beyond the border, in taxels.
const BEYOND: f64 = 0.3;

impl Body {
    /// Draws a body of a class: rectangles with sides of 1 : 1 to 1 : 2.7, fingers of 1 : 2.1 to 1 : 4.2. Any
    /// place and direction in which the body lies on the panel may occur; one body in seven is nearly
    /// parallel to an edge. Areas are those of discs with a radius of 0.9 to 2 taxels (4 rows), 1.4 to 5
    /// (16 rows) and 2 to 10 (others).
    pub fn random(class: Class, [rows, columns]: [u16; 2], rng: &mut Rng) -> Body {
        loop {
            if let Some(body) = Body::drawn(class, [rows, columns], rng) {
                return body;
            }
        }
    }

    /// None if it does not fit on the panel.
    fn drawn(class: Class, [rows, columns]: [u16; 2], rng: &mut Rng) -> Option<Body> {
        let even = |low: f64, high: f64, rng: &mut Rng| range(rng, low.ln(), high.ln()).exp();
        let (least, most) = match rows {
            ..=4 => (0.9, 2.0),
            5..=16 => (1.4, 5.0),
            _ => (2.0, 10.0),
        };
        let radius = even(least, most, rng);
        let (side, ratio) = match class {
            Class::ROUND => (radius, 1.0),
            Class::RECTANGLE => (radius * PI.sqrt() / 2.0, even(1.0, 2.7, rng)),
            _ => (radius, even(2.1, 4.2, rng)),
        };
        let (length, width) = (side * ratio.sqrt(), side / ratio.sqrt());
        let upright = range(rng, 0.0, 1.0) < 0.15;
        let angle = if upright {
            one_of(&[0.0, FRAC_PI_2], rng) + range(rng, -0.05, 0.05)
        } else {
            range(rng, 0.0, PI)
        };
        let (s, c) = (angle.sin().abs(), angle.cos().abs());
        let reach = match class {
            Class::RECTANGLE => [length * c + width * s, length * s + width * c],
            _ => [(length * c).hypot(width * s), (length * s).hypot(width * c)],
        };
        let spare = [f64::from(columns), f64::from(rows)];
        let spare = [0, 1].map(|i| spare[i] + 2.0 * (BEYOND - reach[i]));
        if width < 0.5 * least + 0.2 || spare.iter().any(|spare| *spare < 0.0) {
            return None;
        }
        let [x, y] = [0, 1].map(|i| reach[i] - 0.5 - BEYOND + range(rng, 0.0, spare[i]));
        Some(Body { class, rows, columns, x, y, angle, length, width })
    }

    /// Place across a finger: 0 on its axis, 1 on its rim.
    pub fn rim(&self, end: End, u: f64, v: f64) -> f64 {
        let Body { length, width, .. } = *self;
        match end {
            End::Capsule => (u.abs() - (length - width)).max(0.0).hypot(v) / width,
            End::Blunt => ((u / length).abs().powi(3) + (v / width).abs().powi(3)).cbrt(),
        }
    }

    /// Image of a pressure given at (u, v), along the body and across it: the mean over points of each taxel.
    pub fn image(&self, pressure: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let points = match self.rows {
            ..=4 => 6,
            5..=16 => 5,
            _ => 3,
        };
        let (s, c) = self.angle.sin_cos();
        let reach = self.length.hypot(self.width) + 1.0;
        let taxel = |row: u16, column: u16| {
            let (dx, dy) = (f64::from(column) - self.x, f64::from(row) - self.y);
            if dx.abs() > reach || dy.abs() > reach {
                return 0.0;
            }
            let point = |i: i32| (f64::from(i) + 0.5) / f64::from(points) - 0.5;
            let at = |i: i32| {
                let (x, y) = (dx + point(i % points), dy + point(i / points));
                pressure(x * c + y * s, y * c - x * s)
            };
            (0..points * points).map(at).sum::<f64>() / f64::from(points * points)
        };
        (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| taxel(row, column))).collect()
    }
}
