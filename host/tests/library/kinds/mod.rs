//! Shapes by three generators that share no formula for pressure.
//!
//! | kind | pressure | sensor |
//! |---|---|---|
//! | [`Kind::Area`] | even, the finger softer towards its rim ([`crate::drawn`]) | mean over each taxel |
//! | [`Kind::Elastic`] | of a ball, a pad or a fingertip on an elastic layer | a cover that spreads it |
//! | [`Kind::Indenter`] | depth of a tilted body in foam | crosstalk, spread of gains, noise, filter |
#![allow(dead_code)] // each test that uses this takes a part of it

mod elastic;
mod indenter;
mod sensor;

use crate::drawn::{Rng, Touch};
use taxel_core::condition::Filter;
use taxel_core::shape::Class;

/// How pressure comes about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Area,
    Elastic,
    Indenter,
}

/// All of them.
pub const KINDS: [Kind; 3] = [Kind::Area, Kind::Elastic, Kind::Indenter];

/// What lies between the touch and the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// As the kind's own sensor sees it.
    Clean,
    /// Blurred by up to 0.6 taxel, noise of up to 1 % of the full scale, conservative filter.
    Noisy,
    /// Blurred by 0.3 to 0.9 taxel, noise of 3 % of the full scale, median filter, nothing below 128 counts.
    Hard,
}

/// All of them.
pub const VIEWS: [View; 3] = [View::Clean, View::Noisy, View::Hard];

/// Full scale of the converter.
const FULL: f64 = 4095.0;

/// Where a touch is, and how large; lengths in taxels.
struct Frame {
    x: f64,
    y: f64,
    angle: f64,
    /// Radius of a disc.
    size: f64,
}

/// A number of the normal distribution, nearly: the sum of twelve even ones.
fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| rng.range(-0.5, 0.5)).sum()
}

impl Frame {
    fn random(rows: u16, columns: u16, rng: &mut Rng) -> Frame {
        let (low, high) = match rows.min(columns) {
            ..=4 => (1.0, 1.8),
            5..=16 => (2.0, 4.5),
            _ => (3.5, 9.0),
        };
        let upright = rows <= 4 && rng.range(0.0, 1.0) < 0.6;
        Frame {
            x: f64::from(columns - 1) / 2.0 + rng.range(-0.5, 0.5),
            y: f64::from(rows - 1) / 2.0 + rng.range(-0.5, 0.5),
            angle: if upright { rng.range(-0.3, 0.3) } else { rng.range(0.0, std::f64::consts::PI) },
            size: rng.range(low, high),
        }
    }

    /// The mean of a pressure over 6 x 6 points of each taxel; the greatest is 1.
    fn image(&self, rows: u16, columns: u16, pressure: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let (s, c) = self.angle.sin_cos();
        let taxel = |row: u16, column: u16| {
            let point = |i: i32| (f64::from(i) + 0.5) / 6.0 - 0.5;
            let at = |i: i32| {
                let x = f64::from(column) + point(i % 6) - self.x;
                let y = f64::from(row) + point(i / 6) - self.y;
                pressure(x * c + y * s, y * c - x * s)
            };
            (0..36).map(at).sum::<f64>() / 36.0
        };
        let image: Vec<f64> = (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (row, column)))
            .map(|(r, c)| taxel(r, c))
            .collect();
        let peak = image.iter().copied().fold(1e-9, f64::max);
        image.iter().map(|value| value / peak).collect()
    }
}

/// Half widths of a rectangle with the area of a square of 1.8 by 1.8 sizes.
fn sides(size: f64, rng: &mut Rng) -> [f64; 2] {
    let root = rng.range(1.0, 1.9).sqrt();
    [size * 0.9 * root, size * 0.9 / root]
}

/// Half length and half width of a finger.
fn finger(size: f64, rows: u16, rng: &mut Rng) -> [f64; 2] {
    let half = size * rng.range(0.5, 0.75);
    let length = half * rng.range(1.6, 3.0);
    [if rows <= 4 { length.min(3.4).max(half * 1.35) } else { length }, half]
}

impl Kind {
    /// An image of a random touch.
    pub fn image(self, class: Class, [rows, columns]: [u16; 2], view: View, rng: &mut Rng) -> Vec<u16> {
        let wide = usize::from(columns);
        let mut image: Vec<f64> = match self {
            Kind::Area => {
                let codes = Touch::random(class, rows, columns, rng).codes(rows, columns);
                codes.iter().map(|code| f64::from(code.0)).collect()
            }
            Kind::Elastic => {
                let image = elastic::image(class, [rows, columns], rng);
                let cover = sensor::blurred(&image, wide, rng.range(0.2, 0.5));
                pressed(&cover, rng)
            }
            Kind::Indenter => {
                let image = indenter::image(class, [rows, columns], rng);
                let leaky = sensor::leaky(&image, wide, rng.range(0.0, 0.04));
                let spread = rng.range(0.0, 0.06);
                let uneven: Vec<f64> =
                    leaky.iter().map(|value| value * (1.0 + spread * normal(rng))).collect();
                pressed(&uneven, rng)
            }
        };
        let (blur, noise) = match view {
            View::Clean if self == Kind::Indenter => (0.0, 8.0),
            View::Clean => (0.0, 0.0),
            View::Noisy => (rng.range(0.0, 0.6), rng.range(3.0, 41.0)),
            View::Hard => (rng.range(0.3, 0.9), 0.03 * FULL),
        };
        if blur > 0.0 {
            image = sensor::blurred(&image, wide, blur);
        }
        if noise > 0.0 {
            image.iter_mut().for_each(|value| *value += noise * normal(rng));
        }
        let codes: Vec<u16> = image.iter().map(|value| value.round().clamp(0.0, FULL) as u16).collect();
        match view {
            View::Clean if self != Kind::Indenter => codes,
            View::Clean | View::Noisy => sensor::filtered(&codes, [rows, columns], Filter::Conservative, 24),
            View::Hard => {
                let filtered = sensor::filtered(&codes, [rows, columns], Filter::Median, 1);
                filtered.iter().map(|value| if *value < 128 { 0 } else { *value }).collect()
            }
        }
    }
}

/// At a random gain, in counts.
fn pressed(image: &[f64], rng: &mut Rng) -> Vec<f64> {
    let gain = rng.range(0.2, 0.9) * FULL;
    image.iter().map(|value| value * gain).collect()
}
