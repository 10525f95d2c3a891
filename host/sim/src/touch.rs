//! One touch of a script: shape, place, force and time.

use serde::{Deserialize, Serialize};

/// One touch, possibly repeated: a footprint that appears, moves in a straight line and vanishes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Touch {
    /// Name of the panel of `at`; the touch may continue across its seams.
    pub panel: String,
    /// Shape of the object.
    pub shape: Shape,
    /// Peak force, N.
    pub force_n: f64,
    /// Centre at the start, `[x, y]` in taxels.
    pub at: Option<[f64; 2]>,
    /// Centre at the start, `[x, y]` in mm from the centre of the panel's first taxel.
    pub at_mm: Option<[f64; 2]>,
    /// Size of the footprint, mm; by default the shape's usual size.
    pub size_mm: Option<Size>,
    /// Direction of the footprint's length, degrees from +x towards +y.
    #[serde(default)]
    pub angle_deg: f64,
    /// Onset of the first touch, s.
    pub start_s: f64,
    /// Time from zero to the peak (half a cosine), s.
    #[serde(default = "edge_s")]
    pub rise_s: f64,
    /// Time at the peak, s.
    #[serde(default)]
    pub hold_s: f64,
    /// Time from the peak to zero (half a cosine), s.
    #[serde(default = "edge_s")]
    pub fall_s: f64,
    /// Shares of `force_n` that are reached one after the other, each within `rise_s` and held for `hold_s`:
    /// weights that are put on and taken off again.
    #[serde(default = "whole")]
    pub levels: Vec<f64>,
    /// Velocity of the centre, `[vx, vy]` in taxels per second.
    #[serde(default)]
    pub velocity: [f64; 2],
    /// Number of touches; each starts at the same place.
    #[serde(default = "one_u32")]
    pub repeat: u32,
    /// Time between two onsets, s; by default the length of the touch.
    pub period_s: Option<f64>,
}

impl Touch {
    /// Length of one touch, s.
    pub fn once_s(&self) -> f64 {
        self.levels.len() as f64 * (self.rise_s + self.hold_s) + self.fall_s
    }

    /// End of the last repetition, s.
    pub fn end_s(&self) -> f64 {
        let period = self.period_s.unwrap_or(self.once_s());
        self.start_s + f64::from(self.repeat.saturating_sub(1)) * period + self.once_s()
    }

    /// Length and width of the footprint, mm.
    pub fn size(&self) -> [f64; 2] {
        Size::of(self.size_mm, self.shape)
    }

    /// Initial centre in taxels of a panel with this pitch (mm).
    pub fn centre(&self, pitch_mm: [f64; 2]) -> [f64; 2] {
        match (self.at, self.at_mm) {
            (Some(at), _) => at,
            (None, Some([x, y])) => [x / pitch_mm[0], y / pitch_mm[1]],
            (None, None) => [0.0; 2],
        }
    }
}

/// Shape of a touching object: distribution of pressure over the footprint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// Flat with rounded corners and soft edges 16 mm wide.
    Palm,
    /// Flat rectangle with edges 4 mm wide.
    Strap,
    /// Flat rectangle with edges 3 mm wide.
    Box,
    /// Flat rectangle with sharp edges, for calibration.
    Plate,
    /// Elliptic patch, pressure `sqrt(1 - r^2)` (Hertz); usually 16 mm.
    Finger,
    /// Elliptic patch, pressure `sqrt(1 - r^2)` (Hertz); usually 80 mm.
    Ball,
    /// A cylinder on its side: `sqrt(1 - v^2)` across, flat along; usually 240 x 60 mm.
    Forearm,
    /// A fold of the garment against itself: like a forearm; usually 120 x 24 mm.
    Ridge,
}

impl Shape {
    /// Usual length and width, mm.
    pub const fn usual_mm(self) -> [f64; 2] {
        match self {
            Shape::Palm => [100.0, 85.0],
            Shape::Strap => [250.0, 20.0],
            Shape::Box | Shape::Plate => [60.0, 40.0],
            Shape::Finger => [16.0, 16.0],
            Shape::Ball => [80.0, 80.0],
            Shape::Forearm => [240.0, 60.0],
            Shape::Ridge => [120.0, 24.0],
        }
    }
}

/// Size of a footprint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "must be a number or [length, width]")]
pub enum Size {
    /// Equal in both directions, mm.
    Round(f64),
    /// Length and width, mm.
    Both([f64; 2]),
}

impl Size {
    /// Length and width, mm, of an object; by default its shape's usual ones.
    pub(super) fn of(size: Option<Size>, shape: Shape) -> [f64; 2] {
        match size {
            Some(Size::Round(d)) => [d, d],
            Some(Size::Both(size)) => size,
            None => shape.usual_mm(),
        }
    }
}

fn edge_s() -> f64 {
    0.05
}

fn whole() -> Vec<f64> {
    vec![1.0]
}

fn one_u32() -> u32 {
    1
}
