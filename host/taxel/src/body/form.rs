//! Surfaces that a panel lies on: where each point of the panel comes to lie.
//!
//! A panel bends and does not stretch: on a plane, a cylinder and a cone every distance along the panel is
//! kept.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Flat.
    Plane(Plane),
    /// Around an axis.
    Cylinder(Cylinder),
    /// Around an axis, narrower towards one end.
    Cone(Cone),
    /// Through measured points.
    Grid(Grid),
    /// Each taxel as a file lists it: [`listed`](super::listed).
    Taxels(String),
}

/// A plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Middle of the panel.
    pub at: DVec3,
    /// Direction away from the robot.
    pub normal: DVec3,
    /// Direction in which the rows are counted.
    pub down: DVec3,
}

/// A cylinder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Point of the axis beside the middle of the panel.
    pub at: DVec3,
    /// Direction of the axis, in which the rows are counted.
    pub axis: DVec3,
    /// Radius of the taxels' layer, m.
    pub radius: f64,
    /// Direction from the axis to the middle of the panel.
    pub facing: DVec3,
}

/// A cone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cone {
    /// Point of the axis beside the middle of the panel.
    pub at: DVec3,
    /// Direction of the axis, in which the rows are counted.
    pub axis: DVec3,
    /// Radius beside the middle of the panel, m.
    pub radius: f64,
    /// Direction from the axis to the middle of the panel.
    pub facing: DVec3,
    /// Angle between the axis and the surface, degrees: positive if it narrows along the axis.
    pub angle: f64,
}

/// Measured points, evenly spaced over the panel: the outermost lie on the outermost taxels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Points of each row, from left to right, from the top row down; at least 2 x 2.
    pub points: Vec<Vec<DVec3>>,
}

/// A point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spot {
    pub at: DVec3,
    /// Normal, of length 1.
    pub normal: DVec3,
}

/// Fault of a surface: the key below it, and what it must be.
pub(super) type Unfit = (&'static str, &'static str);

/// Directions of a patch: right, down, outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    pub right: DVec3,
    pub down: DVec3,
    pub out: DVec3,
}

impl Axes {
    /// Least sine of the angle between the two directions that are given: they need not be exactly square.
    const LEAST: f64 = 0.5;

    /// Axes with `down` exactly, and `out` as nearly as it can be.
    pub fn new(down: DVec3, out: DVec3) -> Option<Axes> {
        let down = down.try_normalize()?;
        let out = out.try_normalize()?;
        let across = out - down * out.dot(down);
        let square = (across.length() >= Axes::LEAST).then(|| across.try_normalize())??;
        Some(Axes { right: square.cross(down), down, out: square })
    }
}

impl Plane {
    fn axes(&self) -> Result<Axes, Unfit> {
        Axes::new(self.down, self.normal).ok_or(("down", "must be a direction across `normal`"))
    }
}

impl Cylinder {
    /// The point `(x, y)` of the panel from its middle, in metres.
    fn spot(&self, axes: &Axes, from_middle: DVec2) -> Spot {
        let (sin, cos) = (from_middle.x / self.radius).sin_cos();
        let normal = axes.out * cos + axes.right * sin;
        Spot { at: self.at + axes.down * from_middle.y + normal * self.radius, normal }
    }
}

impl Cone {
    /// A point of the panel from its middle, in metres: its distance from the apex, negative if the cone
    /// widens, and its angle about the axis. None at the apex and beyond it.
    ///
    /// Unrolled, the cone is a sector about its apex, and an angle about the apex is one about the axis times
    /// the sine of the cone's own.
    fn slant(&self, from_middle: DVec2) -> Option<(f64, f64)> {
        let sin = self.angle.to_radians().sin();
        let apex = self.radius / sin;
        let to_apex = DVec2::new(from_middle.x, (apex - from_middle.y) * sin.signum());
        let around = to_apex.x.atan2(to_apex.y) / sin.abs();
        (to_apex.y > 0.0).then(|| (to_apex.length() * sin.signum(), around))
    }

    /// The point `(x, y)` of the panel from its middle, in metres; none at the apex and beyond it.
    fn spot(&self, axes: &Axes, from_middle: DVec2) -> Option<Spot> {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let apex = self.radius / sin;
        let (slant, around) = self.slant(from_middle)?;
        let (side, front) = around.sin_cos();
        let radial = axes.out * front + axes.right * side;
        let at = self.at + axes.down * ((apex - slant) * cos) + radial * (slant * sin);
        Some(Spot { at, normal: radial * cos + axes.down * sin })
    }
}

impl Grid {
    fn rows(&self) -> usize {
        self.points.len()
    }

    fn columns(&self) -> usize {
        self.points.first().map_or(0, Vec::len)
    }

    /// The point of the row and the column, those beyond an edge continued straight.
    fn point(&self, row: isize, column: isize) -> DVec3 {
        let inside = |at: isize, count: usize| at.clamp(0, count as isize - 1);
        let (r, c) = (inside(row, self.rows()), inside(column, self.columns()));
        let held = |row: isize, column: isize| self.points[row as usize][column as usize];
        let beyond = |step: isize, inner: DVec3| (held(r, c) - inner) * step.unsigned_abs() as f64;
        let along_rows = if r == row { DVec3::ZERO } else { beyond(row - r, held(2 * r - row, c)) };
        let along_columns =
            if c == column { DVec3::ZERO } else { beyond(column - c, held(r, 2 * c - column)) };
        held(r, c) + along_rows + along_columns
    }

    /// The point at shares of the panel's height and width, by a Catmull-Rom spline in both directions.
    fn spot(&self, share: DVec2) -> Option<Spot> {
        let along = |share: f64, count: usize| {
            let at = share * (count - 1) as f64;
            let cell = at.floor().clamp(0.0, count as f64 - 2.0);
            (cell as isize, at - cell)
        };
        let (column, x) = along(share.x, self.columns());
        let (row, y) = along(share.y, self.rows());
        let line = |row: isize| {
            let points = [-1, 0, 1, 2].map(|step| self.point(row, column + step));
            (spline(points, x), slope(points, x))
        };
        let lines = [-1, 0, 1, 2].map(|step| line(row + step));
        let down = slope(lines.map(|(at, _)| at), y);
        let right = spline(lines.map(|(_, slope)| slope), y);
        Some(Spot { at: spline(lines.map(|(at, _)| at), y), normal: down.cross(right).try_normalize()? })
    }
}

/// Catmull-Rom spline through the middle two of four points, at `t` of the way.
fn spline([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    let (bend, twist) = (a * 2.0 - b * 5.0 + c * 4.0 - d, (b - c) * 3.0 + d - a);
    (b * 2.0 + ((c - a) + (bend + twist * t) * t) * t) * 0.5
}

/// Returns the slope of the spline.
fn slope([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    let (bend, twist) = (a * 2.0 - b * 5.0 + c * 4.0 - d, (b - c) * 3.0 + d - a);
    ((c - a) + (bend * 2.0 + twist * (3.0 * t)) * t) * 0.5
}

/// A point of a panel, for any surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct PanelSpot {
    /// From its middle, m; x to the right, y down.
    pub from_middle: DVec2,
    /// Place to which the way of the panel over the surface has taken it, m, as `from_middle`.
    pub moved: DVec2,
    /// Share of the way from the first to the last taxel, along x and along y.
    pub share: DVec2,
}

/// A surface, ready to place points.
#[derive(Debug)]
pub(super) enum Laid<'a> {
    Plane(&'a Plane, Axes),
    Cylinder(&'a Cylinder, Axes),
    Cone(&'a Cone, Axes),
    Grid(&'a Grid),
}

impl<'a> Laid<'a> {
    /// Checks a surface; none for one that a file lists.
    pub fn new(form: &'a Form) -> Result<Option<Laid<'a>>, Unfit> {
        let round = |axis: DVec3, facing: DVec3, radius: f64| {
            if !(radius > 0.0 && radius.is_finite()) {
                return Err(("radius", "must be above 0"));
            }
            Axes::new(axis, facing).ok_or(("facing", "must be a direction across `axis`"))
        };
        Ok(Some(match form {
            Form::Plane(plane) => Laid::Plane(plane, plane.axes()?),
            Form::Cylinder(it) => Laid::Cylinder(it, round(it.axis, it.facing, it.radius)?),
            Form::Cone(it) => {
                let axes = round(it.axis, it.facing, it.radius)?;
                if !(0.01..90.0).contains(&it.angle.abs()) {
                    return Err(("angle", "must be 0.01 to below 90 degrees, or the same negative"));
                }
                Laid::Cone(it, axes)
            }
            Form::Grid(grid) => {
                let columns = grid.columns();
                if grid.rows() < 2 || columns < 2 || grid.points.iter().any(|row| row.len() != columns) {
                    return Err(("points", "must be at least two rows of as many points each, at least two"));
                }
                Laid::Grid(grid)
            }
            Form::Taxels(_) => return Ok(None),
        }))
    }

    /// Returns where a point of the panel lies; none where the panel does not fit on the surface. A panel that goes
    /// once around still does when it is shifted.
    pub fn spot(&self, at: &PanelSpot) -> Option<Spot> {
        let PanelSpot { from_middle, moved, share } = *at;
        match self {
            Laid::Plane(plane, axes) => {
                let at = plane.at + axes.right * moved.x + axes.down * moved.y;
                Some(Spot { at, normal: axes.out })
            }
            Laid::Cylinder(cylinder, axes) => {
                let fits = from_middle.x.abs() <= PI * cylinder.radius;
                fits.then(|| cylinder.spot(axes, moved))
            }
            Laid::Cone(cone, axes) => {
                let (_, around) = cone.slant(from_middle)?;
                if around.abs() > PI { None } else { cone.spot(axes, moved) }
            }
            Laid::Grid(grid) => grid.spot(share),
        }
    }
}
