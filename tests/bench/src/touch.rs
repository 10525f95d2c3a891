//! Exactly drawn touches: discs, squares, rectangles and fingers, turned, scaled, shifted and pressed.

use super::outline::Outline;

/// Varied parameters, in the order of [`TouchPlacement::varied`].
pub const VARIED: [&str; 4] = ["rotation", "scale", "shift", "pressure"];
/// Layers of a finger's dome.
const LAYERS: usize = 8;

/// Shape of a touch.
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
    /// All shapes, in the order of the rows.
    pub const ALL: [Shape; 4] = [Shape::Disc, Shape::Square, Shape::Rectangle, Shape::Finger];

    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Disc => "disc",
            Shape::Square => "square",
            Shape::Rectangle => "rectangle",
            Shape::Finger => "finger",
        }
    }

    /// Outlines stacked on each other, each with its share of the pressure.
    pub fn layers(self, radius: f64) -> Vec<(Outline, f64)> {
        let side = radius * std::f64::consts::PI.sqrt() / 2.0;
        match self {
            Shape::Disc => vec![(Outline::disc(radius), 1.0)],
            Shape::Square => vec![(Outline::rectangle(side, side), 1.0)],
            Shape::Rectangle => {
                vec![(Outline::rectangle(side * 2f64.sqrt(), side / 2f64.sqrt()), 1.0)]
            }
            Shape::Finger => {
                // Pressure of a ball on soft ground, sqrt(1 - r^2): place of a layer, from the rim.
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
pub struct TouchPlacement {
    /// Rotation, radians.
    pub angle: f64,
    /// Scale relative to the grid's size.
    pub scale: f64,
    /// Offset of the centre from the grid's, taxels.
    pub shift: [f64; 2],
    /// Greatest pressure as a share of full scale.
    pub gain: f64,
}

/// Values of the parameters that do not vary.
pub const STILL: TouchPlacement =
    TouchPlacement { angle: 17.0 * DEGREE, scale: 1.0, shift: [0.13, 0.29], gain: 0.5 };
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl TouchPlacement {
    /// Touches of one variation, by its index in [`VARIED`].
    pub fn varied(variation: usize) -> Vec<TouchPlacement> {
        let part = |step: i32, of: i32| f64::from(step) / f64::from(of);
        match variation {
            0 => (0..=30).map(|i| TouchPlacement { angle: 90.0 * DEGREE * part(i, 30), ..STILL }).collect(),
            1 => (0..=30).map(|i| TouchPlacement { scale: 0.5 * 4f64.powf(part(i, 30)), ..STILL }).collect(),
            2 => {
                let at = |i: i32| [part(i % 8, 8) - 0.5, part(i / 8, 8) - 0.5];
                (0..64).map(|i| TouchPlacement { shift: at(i), ..STILL }).collect()
            }
            _ => (0..=14).map(|i| TouchPlacement { gain: 0.2 + 0.7 * part(i, 14), ..STILL }).collect(),
        }
    }
}
