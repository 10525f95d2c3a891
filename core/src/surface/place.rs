//! Place of a contact: between the four taxels around its centroid.

use super::table::Table;
use super::taxel::TaxelRecord;
use super::{Micrometres, ONE, UnitVector};
use crate::format::{Fixed16, Inverse, root, signed_wide};
use crate::garment::{Area, Layout};
use serde::{Deserialize, Serialize};

/// A point of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SurfacePoint {
    /// Index of the link in the table.
    pub link: u8,
    /// Its place in the frame of the link; at most 55 um from the mean of the taxels' exact places.
    pub at: Micrometres,
    /// Direction away from the robot.
    pub normal: UnitVector,
}

/// Further binary digits of a place between taxels: 2^-20 m, about 1 um.
const FINE: u32 = 6;

impl Table<'_> {
    /// The point at `(x, y)` of a panel, taxels: linear between the four around it, and the nearest point of
    /// the panel from outside. None where one of these has no place.
    #[inline(never)] // M0+: out of line
    pub fn spot(&self, layout: &Layout, panel: u8, x: Fixed16, y: Fixed16) -> Option<SurfacePoint> {
        let area = layout.areas().get(usize::from(panel))?;
        let ((column, x), (row, y)) = (within(x, area.columns), within(y, area.rows));
        let right = if x > 0 { column + 1 } else { column };
        let above = self.between(area, row, [column, right], x)?;
        let below = if y > 0 { self.between(area, row + 1, [column, right], x)? } else { above };
        let Fine { link, at, normal } = above.mixed(&below, y);
        Some(SurfacePoint { link, at: at.map(micrometres), normal: unit(normal)? })
    }

    /// Between two taxels of a row.
    fn between(&self, area: &Area, row: u16, columns: [u16; 2], share: u32) -> Option<Fine> {
        let of = |column| {
            let taxel =
                usize::from(area.base) + usize::from(row) * usize::from(area.columns) + usize::from(column);
            self.taxels().get(taxel).filter(|taxel| taxel.is_placed())
        };
        let [left, right] = [of(columns[0])?, of(columns[1])?].map(Fine::of);
        Some(left.mixed(&right, share))
    }
}

/// Place and normal in units of 2^-20.
#[derive(Clone, Copy)]
struct Fine {
    link: u8,
    at: [i32; 3],
    normal: [i32; 3],
}

impl Fine {
    fn of(taxel: &TaxelRecord) -> Fine {
        let [at, normal] = [taxel.at, taxel.normal].map(|v| v.map(|x| i32::from(x) << FINE));
        Fine { link: taxel.link as u8, at, normal }
    }

    /// A share of the way to another.
    fn mixed(&self, to: &Fine, share: u32) -> Fine {
        let (at, normal) = (mix(self.at, to.at, share), mix(self.normal, to.normal, share));
        Fine { link: self.link, at, normal }
    }
}

/// The taxel at or before a coordinate, and the share of the next one in units of 2^-16; limited to the
/// panel.
fn within(at: Fixed16, count: u16) -> (u16, u32) {
    let last = i32::from(count.saturating_sub(1)) << 16;
    let at = at.0.max(0).min(last);
    ((at >> 16) as u16, (at & 0xffff) as u32)
}

/// `a` plus a share of the way to `b`, rounded.
#[inline(never)] // M0+: out of line
fn mix([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3], share: u32) -> [i32; 3] {
    [(ax, bx), (ay, by), (az, bz)].map(|(a, b)| a + ((signed_wide(b - a, share) + (1 << 15)) >> 16) as i32)
}

/// 2^-20 m to micrometres, rounded.
#[inline(never)] // M0+: out of line
fn micrometres(fine: i32) -> i32 {
    ((signed_wide(fine, 1_000_000) + (1 << 19)) >> 20) as i32
}

/// The direction of a vector in units of 2^-20; none if it is shorter than 1/16.
fn unit(vector: [i32; 3]) -> Option<UnitVector> {
    let length = root(vector.iter().map(|x| u64::from(x.unsigned_abs()).pow(2)).sum());
    if length < 1 << 16 {
        return None;
    }
    let inverse = Inverse::of(length);
    Some(
        vector.map(|x| rounded(&inverse, i64::from(x) << 14, length).clamp((-ONE).into(), ONE.into()) as i16),
    )
}

/// `sum` divided by a total, rounded.
#[inline(never)] // M0+: out of line
pub(super) fn rounded(inverse: &Inverse, sum: i64, total: u32) -> i32 {
    let size = inverse.quotient(sum.unsigned_abs() + u64::from(total / 2)) as i32;
    if sum < 0 { -size } else { size }
}
