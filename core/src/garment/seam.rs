//! Seams: edges along which two panels touch, and the transform of coordinates across them.

use super::area::Area;
use super::config::{Seam, SeamEdge, Side};
use super::error::GarmentError;
use core::ops::RangeInclusive;

/// Integer transform of taxel coordinates, a quarter turn or reflection and a shift:
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
    /// Leaves coordinates unchanged.
    pub const IDENTITY: Transform = Transform { xx: 1, xy: 0, yx: 0, yy: 1, dx: 0, dy: 0 };

    /// Transforms a point whose coordinates are in units of `1 / one` taxel.
    pub const fn apply(&self, x: i64, y: i64, one: i64) -> (i64, i64) {
        (
            signed(self.xx, x) + signed(self.xy, y) + self.dx as i64 * one,
            signed(self.yx, x) + signed(self.yy, y) + self.dy as i64 * one,
        )
    }

    /// Composition: applies `first`, then `self`.
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

    /// Inverse transform (the linear part is orthogonal, so its inverse is the transpose).
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

/// Returns `factor * value` for a factor of -1, 0 or 1.
pub(crate) const fn signed(factor: i32, value: i64) -> i64 {
    match factor {
        0 => 0,
        1.. => value,
        _ => -value,
    }
}

/// Taxels of a panel along a seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// The side of the panel.
    pub side: Side,
    first: GridPoint,
    along: GridPoint,
}

impl Stretch {
    /// `(x, y)` of taxel `number` of the stretch.
    pub const fn at(&self, number: i32) -> (i32, i32) {
        (self.first.0 + self.along.0 * number, self.first.1 + self.along.1 * number)
    }
}

/// A checked seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Joint {
    /// Index of the first panel.
    pub a: u8,
    /// Index of the second panel.
    pub b: u8,
    /// Taxels along the seam.
    pub length: u16,
    /// Transform from coordinates of panel `b` to those of panel `a`.
    pub b_to_a: Transform,
    /// Taxels of panel `a` along the seam, from the top or left.
    pub edge_a: Stretch,
    /// Taxels of panel `b` along the seam, in the same order.
    pub edge_b: Stretch,
}

impl Joint {
    pub(super) fn build(index: usize, seam: &Seam, a: &Area, b: &Area) -> Result<Joint, GarmentError> {
        let (edge_a, a_out) = stretch(index, &seam.a, seam.length, a)?;
        let (mut edge_b, b_out) = stretch(index, &seam.b, seam.length, b)?;
        let (from, to) = (u32::from(seam.a.start), u32::from(seam.b.start));
        let same = (seam.a.panel, seam.a.side) == (seam.b.panel, seam.b.side);
        if same && from.abs_diff(to) < u32::from(seam.length) {
            return Err(GarmentError::SelfSewn(index));
        }
        if seam.reversed {
            edge_b.first = edge_b.at(i32::from(seam.length) - 1);
            edge_b.along = (-edge_b.along.0, -edge_b.along.1);
        }
        let (a_at, a_along, b_at, b_along) = (edge_a.first, edge_a.along, edge_b.first, edge_b.along);
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
        Ok(Joint { a: seam.a.panel, b: seam.b.panel, length: seam.length, b_to_a, edge_a, edge_b })
    }

    /// Taxels of panel `b` that adjoin taxels `first ..= last` of panel `a`, corners included.
    pub fn beside(&self, first: i32, last: i32) -> RangeInclusive<i32> {
        (first - 1).max(0)..=(last + 1).min(i32::from(self.length) - 1)
    }

    /// Pairs of 8-connected taxels across the seam: `((x, y) in panel a, (x, y) in panel b)`.
    pub fn neighbours(&self) -> impl Iterator<Item = ((i32, i32), (i32, i32))> + '_ {
        (0..i32::from(self.length))
            .flat_map(move |i| self.beside(i, i).map(move |j| (self.edge_a.at(i), self.edge_b.at(j))))
    }
}

type GridPoint = (i32, i32);

/// Returns a stretch of a panel's side, and the direction out of the panel.
fn stretch(
    seam: usize,
    edge: &SeamEdge,
    length: u16,
    area: &Area,
) -> Result<(Stretch, GridPoint), GarmentError> {
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
    Ok((Stretch { side: edge.side, first, along }, out))
}
