//! Touches that are drawn exactly: discs, squares, rectangles and fingers, turned, scaled, shifted and pressed.

use super::outline::Outline;

/// What varies, in the order of [`Touch::varied`].
pub const VARIED: [&str; 4] = ["rotation", "scale", "shift", "pressure"];
/// Steps that make up the dome of a finger.
const LAYERS: usize = 8;

/// What touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Even pressure.
    Disc,
    /// Even pressure, the disc's area.
    Square,
    /// Even pressure, the disc's area, twice as long as wide.
    Rectangle,
    /// A capsule, softer towards its rim.
    Finger,
}

impl Shape {
    /// All, in the order of the rows.
    pub const ALL: [Shape; 4] = [Shape::Disc, Shape::Square, Shape::Rectangle, Shape::Finger];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Disc => "disc",
            Shape::Square => "square",
            Shape::Rectangle => "rectangle",
            Shape::Finger => "finger",
        }
    }

    /// Outlines that are pressed one upon the other, each with its part of the pressure.
    pub fn layers(self, radius: f64) -> Vec<(Outline, f64)> {
        let side = radius * std::f64::consts::PI.sqrt() / 2.0;
        match self {
            Shape::Disc => vec![(Outline::disc(radius), 1.0)],
            Shape::Square => vec![(Outline::rectangle(side, side), 1.0)],
            Shape::Rectangle => {
                vec![(Outline::rectangle(side * 2f64.sqrt(), side / 2f64.sqrt()), 1.0)]
            }
            Shape::Finger => {
                // A ball's pressure on a soft ground, sqrt(1 - r^2): where a layer lies, seen from its rim.
                let layer = |index: usize| {
                    let height = (index as f64 + 0.5) / LAYERS as f64;
                    let across = 0.65 * radius * (1.0 - height * height).sqrt();
                    (Outline::capsule(0.6 * radius, across), 1.0 / LAYERS as f64)
                };
                (0..LAYERS).map(layer).collect()
            }
        }
    }
}

/// One touch of a shape.
#[derive(Debug, Clone, Copy)]
pub struct Touch {
    /// Radians.
    pub angle: f64,
    /// Of the size on that grid.
    pub scale: f64,
    /// Of the centre from the grid's, in taxels.
    pub shift: [f64; 2],
    /// Greatest pressure as a part of full scale.
    pub gain: f64,
}

/// What the others stay at while one thing varies.
pub const STILL: Touch = Touch { angle: 17.0 * DEGREE, scale: 1.0, shift: [0.13, 0.29], gain: 0.5 };
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Touch {
    /// The touches under one variation: its index in [`VARIED`].
    pub fn varied(variation: usize) -> Vec<Touch> {
        let part = |step: i32, of: i32| f64::from(step) / f64::from(of);
        match variation {
            0 => (0..=30).map(|i| Touch { angle: 90.0 * DEGREE * part(i, 30), ..STILL }).collect(),
            1 => (0..=30).map(|i| Touch { scale: 0.5 * 4f64.powf(part(i, 30)), ..STILL }).collect(),
            2 => {
                let at = |i: i32| [part(i % 8, 8) - 0.5, part(i / 8, 8) - 0.5];
                (0..64).map(|i| Touch { shift: at(i), ..STILL }).collect()
            }
            _ => (0..=14).map(|i| Touch { gain: 0.2 + 0.7 * part(i, 14), ..STILL }).collect(),
        }
    }
}
