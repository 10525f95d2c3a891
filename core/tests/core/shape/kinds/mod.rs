//! Rectangles, discs and fingers by three generators that share no formula for pressure.
//!
//! | kind | pressure | sensor |
//! |---|---|---|
//! | [`Generator::Polygon`] | even within a hard edge; a finger may be softer at the rim | mean over a taxel |
//! | [`Generator::Elastic`] | of a punch, a pad or a ball on an elastic half space | a cloth that spreads it |
//! | [`Generator::Depth`] | depth of a tilted body with a rounded edge in foam | crosstalk, spread of gains |
//!
//! [`Body::random`] says what counts as a rectangle, a disc and a finger.

mod body;
mod depth;
mod elastic;
mod polygon;
mod sensor;

use crate::shape::range;
use body::Body;
use fastrand::Rng;
use taxel_core::condition::Filter;
use taxel_core::shape::Class;

/// How pressure comes about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Generator {
    Polygon,
    Elastic,
    Depth,
}

/// All of them.
pub const GENERATORS: [Generator; 3] = [Generator::Polygon, Generator::Elastic, Generator::Depth];

/// What the sensor makes of the touch. In all views the gain is 0.2 to 0.9, and what is below 1.5 to 5 % of
/// the full scale (5 % if hard) is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quality {
    /// No blur, no noise.
    Clean,
    /// Blur of up to 0.6 taxel, noise of 0.1 to 1 % of the full scale, conservative filter.
    Noisy,
    /// Blur of up to 0.8 taxel, noise of 3 % of the full scale, median filter; none on 4 rows, where it
    /// would delete fingers.
    Hard,
}

/// All of them.
pub const QUALITIES: [Quality; 3] = [Quality::Clean, Quality::Noisy, Quality::Hard];

/// Full scale of the converter.
const FULL: f64 = 4095.0;

/// A number of the normal distribution, nearly: the sum of twelve even ones.
fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| range(rng, -0.5, 0.5)).sum()
}

/// One of several.
fn one_of<T: Copy>(choices: &[T], rng: &mut Rng) -> T {
    choices[range(rng, 0.0, choices.len() as f64) as usize]
}

impl Generator {
    /// An image of a random touch.
    pub fn image(self, class: Class, [rows, columns]: [u16; 2], quality: Quality, rng: &mut Rng) -> Vec<u16> {
        let body = Body::random(class, [rows, columns], rng);
        let image = match self {
            Generator::Polygon => polygon::image(&body, rng),
            Generator::Elastic => {
                sensor::blurred(&elastic::image(&body, rng), columns.into(), range(rng, 0.15, 0.5))
            }
            Generator::Depth => {
                let leaky = sensor::leaky(&depth::image(&body, rng), columns.into(), range(rng, 0.0, 0.04));
                let spread = range(rng, 0.0, 0.06);
                leaky.iter().map(|value| value * (1.0 + spread * normal(rng))).collect()
            }
        };
        seen(&image, [rows, columns], quality, rng)
    }
}

/// Codes of a pressure at a random gain.
fn seen(image: &[f64], [rows, columns]: [u16; 2], quality: Quality, rng: &mut Rng) -> Vec<u16> {
    let peak = image.iter().copied().fold(1e-9, f64::max);
    let gain = range(rng, 0.2, 0.9) * FULL / peak;
    let least = if quality == Quality::Hard { 0.05 } else { range(rng, 0.015, 0.05) } * FULL;
    let mut image: Vec<f64> = image.iter().map(|value| value * gain).collect();
    let (blur, noise) = match quality {
        Quality::Clean => (0.0, 0.0),
        Quality::Noisy => (range(rng, 0.05, 0.6), range(rng, 0.001, 0.01)),
        Quality::Hard => (range(rng, 0.05, 0.8), 0.03),
    };
    if quality != Quality::Clean {
        image = sensor::blurred(&image, columns.into(), blur);
        image.iter_mut().for_each(|value| *value += noise * FULL * normal(rng));
    }
    let codes: Vec<u16> = image.iter().map(|value| value.round().clamp(0.0, FULL) as u16).collect();
    let filter = match quality {
        Quality::Noisy => Filter::Conservative,
        Quality::Hard if rows > 4 => Filter::Median,
        _ => Filter::Off,
    };
    let values = sensor::filtered(&codes, [rows, columns], filter);
    values.iter().map(|value| if f64::from(*value) < least { 0 } else { *value }).collect()
}
