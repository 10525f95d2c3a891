//! The plane of a seam: both panels laid flat, edge to edge, and measured from the line between them.

use super::board::RobotBoard;
use super::seam::{RobotEdge, RobotSeam};
use taxel_core::garment::Side;

/// Pitch of a panel that gives none, mm.
const USUAL_PITCH_MM: f64 = 10.0;

/// A point of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanePoint {
    /// Along the seam, taxels from its first.
    pub along: f64,
    /// Across the seam, mm: below 0 on panel `a`, above 0 on panel `b`.
    pub across: f64,
}

/// A panel at a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneSide {
    /// Where it is.
    pub edge: RobotEdge,
    /// First taxel of the seam, `[x, y]` in taxels of the panel; the steps to the next one, and out of the
    /// panel.
    first: [f64; 2],
    along: [f64; 2],
    out: [f64; 2],
    /// Distance of taxels across the seam, mm.
    pitch_mm: f64,
    /// -1 for panel `a`, 1 for panel `b`.
    sign: f64,
}

/// The plane of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeamPlane {
    /// Panels `a` and `b`.
    pub sides: [PlaneSide; 2],
    /// Taxels along the seam.
    pub length: f64,
}

impl SeamPlane {
    /// Of a seam between these boards; none if a board's garment is unknown.
    pub fn of(seam: &RobotSeam, boards: &[RobotBoard]) -> Option<SeamPlane> {
        let length = f64::from(seam.length);
        let side = |edge: RobotEdge, sign| PlaneSide::of(edge, sign, boards);
        let (a, mut b) = (side(seam.a, -1.0)?, side(seam.b, 1.0)?);
        if seam.reversed {
            b.first = plus(b.first, b.along, length - 1.0);
            b.along = b.along.map(|step| -step);
        }
        Some(SeamPlane { sides: [a, b], length })
    }
}

impl PlaneSide {
    fn of(edge: RobotEdge, sign: f64, boards: &[RobotBoard]) -> Option<PlaneSide> {
        let worn = boards.get(edge.board)?.garment.as_ref()?;
        let area = worn.layout.areas().get(usize::from(edge.panel))?;
        let (right, bottom) = (f64::from(area.columns) - 1.0, f64::from(area.rows) - 1.0);
        let start = f64::from(edge.start);
        let (first, along, out) = match edge.side {
            Side::Left => ([0.0, start], [0.0, 1.0], [-1.0, 0.0]),
            Side::Right => ([right, start], [0.0, 1.0], [1.0, 0.0]),
            Side::Top => ([start, 0.0], [1.0, 0.0], [0.0, -1.0]),
            Side::Bottom => ([start, bottom], [1.0, 0.0], [0.0, 1.0]),
        };
        let [x_mm, y_mm] = pitch_mm(area.pitch_um);
        let pitch_mm = if out[0] == 0.0 { y_mm } else { x_mm };
        Some(PlaneSide { edge, first, along, out, pitch_mm, sign })
    }

    /// Distance of taxels across the seam, mm.
    pub fn pitch_mm(&self) -> f64 {
        self.pitch_mm
    }

    /// True for panel `a`.
    pub fn is_first(&self) -> bool {
        self.sign < 0.0
    }

    /// The point of the plane at `[x, y]`, taxels of the panel.
    pub fn in_plane(&self, at: [f64; 2]) -> PlanePoint {
        let from = [at[0] - self.first[0], at[1] - self.first[1]];
        // Half a taxel lies between the line and the centres of the first taxels.
        let inside = (0.5 - dot(from, self.out)) * self.pitch_mm;
        PlanePoint { along: dot(from, self.along), across: self.sign * inside }
    }

    /// `[x, y]` of a point of the plane, taxels of the panel, also beyond its edge.
    pub fn onto_panel(&self, point: PlanePoint) -> [f64; 2] {
        let outside = 0.5 - self.sign * point.across / self.pitch_mm;
        plus(plus(self.first, self.along, point.along), self.out, outside)
    }
}

/// Distance of taxels along x and y, mm.
pub fn pitch_mm(pitch_um: [u32; 2]) -> [f64; 2] {
    pitch_um.map(|um| if um == 0 { USUAL_PITCH_MM } else { f64::from(um) / 1000.0 })
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn plus(at: [f64; 2], step: [f64; 2], times: f64) -> [f64; 2] {
    [at[0] + times * step[0], at[1] + times * step[1]]
}
