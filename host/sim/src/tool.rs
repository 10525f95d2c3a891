//! Tool with which a hand presses the garment.

use super::footprint::is_too_fine;
use super::pressure::pitch_mm;
use super::touch::{Shape, Size};
use super::trace::Trace;
use taxel_core::garment::Layout;

/// A tool: an object with a size, and the forces that people use it with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// Name.
    pub name: &'static str,
    /// Shape of the object.
    pub shape: Shape,
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// Force of a short press, N.
    pub force_n: f64,
    /// Most that a long press comes to, N.
    pub most_n: f64,
}

const fn tool(name: &'static str, shape: Shape, size_mm: [f64; 2], [force_n, most_n]: [f64; 2]) -> Tool {
    Tool { name, shape, size_mm, force_n, most_n }
}

/// All tools.
pub const TOOLS: [Tool; 6] = [
    tool("fingertip", Shape::Finger, [16.0, 16.0], [3.0, 30.0]),
    tool("pen", Shape::Finger, [6.0, 6.0], [1.5, 10.0]),
    tool("palm", Shape::Palm, Shape::Palm.usual_mm(), [8.0, 100.0]),
    tool("forearm", Shape::Forearm, Shape::Forearm.usual_mm(), [15.0, 150.0]),
    tool("ball", Shape::Ball, Shape::Ball.usual_mm(), [10.0, 100.0]),
    tool("strap", Shape::Strap, Shape::Strap.usual_mm(), [10.0, 60.0]),
];

impl Tool {
    /// True if every panel of a garment is coarse enough for it.
    pub fn fits(&self, layout: &Layout) -> bool {
        let fits = |angle: f64| {
            layout.areas().iter().all(|area| !is_too_fine(self.shape, self.size_mm, angle, pitch_mm(area)))
        };
        // The bounding box is largest at some angle in between.
        [0.0, 45.0, 90.0].into_iter().all(fits)
    }

    /// Returns its touch on a panel, without a path.
    pub fn trace(&self, panel: &str, angle_deg: f64) -> Trace {
        let size = Size::Both(self.size_mm);
        let size_mm = (self.size_mm != self.shape.usual_mm()).then_some(size);
        Trace { panel: panel.into(), shape: self.shape, size_mm, angle_deg, path: Vec::new() }
    }
}
