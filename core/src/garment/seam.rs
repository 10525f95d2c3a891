//! Seams: where a contact passes from one panel to another, and how coordinates follow it.

use super::area::Area;
use super::config::{Edge, Seam, Side};
use super::error::GarmentError;

/// An integer map of taxel coordinates, a quarter turn or reflection and a shift:
/// `x' = xx x + xy y + dx`, `y' = yx x + yy y + dy`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Transform {
    /// coefficient of x in x'
    pub xx: i32,
    /// coefficient of y in x'
    pub xy: i32,
    /// coefficient of x in y'
    pub yx: i32,
    /// coefficient of y in y'
    pub yy: i32,
    /// shift of x'
    pub dx: i32,
    /// shift of y'
    pub dy: i32,
}

impl Transform {
    /// Leaves coordinates as they are.
    pub const IDENTITY: Transform = Transform { xx: 1, xy: 0, yx: 0, yy: 1, dx: 0, dy: 0 };

    /// Image of a point whose coordinates are in units of `1 / one` taxel.
    pub const fn apply(&self, x: i64, y: i64, one: i64) -> (i64, i64) {
        (
            self.xx as i64 * x + self.xy as i64 * y + self.dx as i64 * one,
            self.yx as i64 * x + self.yy as i64 * y + self.dy as i64 * one,
        )
    }

    /// The map that applies `first`, then `self`.
    pub const fn after(&self, first: &Transform) -> Transform {
        Transform {
            xx: self.xx * first.xx + self.xy * first.yx,
            xy: self.xx * first.xy + self.xy * first.yy,
            yx: self.yx * first.xx + self.yy * first.yx,
            yy: self.yx * first.xy + self.yy * first.yy,
            dx: self.xx * first.dx + self.xy * first.dy + self.dx,
            dy: self.yx * first.dx + self.yy * first.dy + self.dy,
        }
    }

    /// The map that undoes this one (its linear part is orthogonal, so the inverse is the transpose).
    pub const fn inverse(&self) -> Transform {
        Transform {
            xx: self.xx,
            xy: self.yx,
            yx: self.xy,
            yy: self.yy,
            dx: -(self.xx * self.dx + self.yx * self.dy),
            dy: -(self.xy * self.dx + self.yy * self.dy),
        }
    }
}

/// A checked seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Joint {
    /// Index of the one panel.
    pub a: u8,
    /// Index of the other panel.
    pub b: u8,
    /// Taxels along the seam.
    pub length: u16,
    /// Coordinates of panel `b` to those of panel `a`.
    pub b_to_a: Transform,
    first: (i32, i32),
    along: (i32, i32),
    out: (i32, i32),
}

impl Joint {
    pub(super) fn build(index: usize, seam: &Seam, a: &Area, b: &Area) -> Result<Joint, GarmentError> {
        let (a_at, a_along, a_out) = stretch(index, &seam.a, seam.length, a)?;
        let (mut b_at, mut b_along, b_out) = stretch(index, &seam.b, seam.length, b)?;
        if seam.reversed {
            let last = i32::from(seam.length) - 1;
            b_at = (b_at.0 + b_along.0 * last, b_at.1 + b_along.1 * last);
            b_along = (-b_along.0, -b_along.1);
        }
        // Linear part: along b becomes along a, into b becomes out of a; both pairs are orthonormal.
        let into_b = (-b_out.0, -b_out.1);
        let linear = Transform {
            xx: a_along.0 * b_along.0 + a_out.0 * into_b.0,
            xy: a_along.0 * b_along.1 + a_out.0 * into_b.1,
            yx: a_along.1 * b_along.0 + a_out.1 * into_b.0,
            yy: a_along.1 * b_along.1 + a_out.1 * into_b.1,
            dx: 0,
            dy: 0,
        };
        let (x, y) = linear.apply(i64::from(b_at.0), i64::from(b_at.1), 1);
        let b_to_a = Transform { dx: a_at.0 + a_out.0 - x as i32, dy: a_at.1 + a_out.1 - y as i32, ..linear };
        Ok(Joint {
            a: seam.a.panel,
            b: seam.b.panel,
            length: seam.length,
            b_to_a,
            first: a_at,
            along: a_along,
            out: a_out,
        })
    }

    /// Pairs of 8-connected taxels across the seam: `((x, y) in panel a, (x, y) in panel b)`.
    pub fn neighbours(&self) -> impl Iterator<Item = ((i32, i32), (i32, i32))> + '_ {
        let a_to_b = self.b_to_a.inverse();
        let last = i32::from(self.length) - 1;
        (0..=last).flat_map(move |i| {
            ((i - 1).max(0)..=(i + 1).min(last)).map(move |j| {
                let at = |k: i32| (self.first.0 + self.along.0 * k, self.first.1 + self.along.1 * k);
                let (a, beside) = (at(i), at(j));
                let (x, y) =
                    a_to_b.apply(i64::from(beside.0 + self.out.0), i64::from(beside.1 + self.out.1), 1);
                (a, (x as i32, y as i32))
            })
        })
    }
}

type Point = (i32, i32);

/// First taxel, direction along and direction out of a stretch of a panel's side.
fn stretch(
    seam: usize,
    edge: &Edge,
    length: u16,
    area: &Area,
) -> Result<(Point, Point, Point), GarmentError> {
    let (right, bottom) = (i32::from(area.columns) - 1, i32::from(area.rows) - 1);
    let start = i32::from(edge.start);
    let (first, along, out, side_length) = match edge.side {
        Side::Left => ((0, start), (0, 1), (-1, 0), area.rows),
        Side::Right => ((right, start), (0, 1), (1, 0), area.rows),
        Side::Top => ((start, 0), (1, 0), (0, -1), area.columns),
        Side::Bottom => ((start, bottom), (1, 0), (0, 1), area.columns),
    };
    if length == 0 || u32::from(edge.start) + u32::from(length) > u32::from(side_length) {
        return Err(GarmentError::OutsideSide { seam, panel: area.name.clone(), side: edge.side });
    }
    Ok((first, along, out))
}
