//! Place of a contact: between the four taxels around its centroid.

use super::table::Table;
use super::taxel::{TaxelRecord, micrometres};
use super::{Micrometres, UnitVector};
use crate::format::Fixed16;
use crate::garment::Layout;
use serde::{Deserialize, Serialize};

/// A point of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SurfacePoint {
    /// Index of the link in the table.
    pub link: u8,
    /// Place in the frame of the link; at most 55 um from the mean of the taxels' exact places.
    pub at: Micrometres,
    /// Direction away from the robot.
    pub normal: UnitVector,
}

/// WeightedSum of the weights of the four taxels around a point: products with 16 bits fit in 32.
const WHOLE: u32 = 1 << 16;

impl Table<'_> {
    /// The point at `(x, y)` of a panel, taxels: linear between the four around it, and the nearest point of
    /// the panel from outside. None where one of these has no place.
    #[inline(never)] // M0+: out of line
    pub fn spot(&self, layout: &Layout, panel: u8, x: Fixed16, y: Fixed16) -> Option<SurfacePoint> {
        let area = layout.areas().get(usize::from(panel))?;
        let ((column, x), (row, y)) = (within(x, area.columns), within(y, area.rows));
        let both = (x * y) >> 14;
        let (right, below) = (2 * x - both, 2 * y - both);
        let first =
            usize::from(area.base) + usize::from(row) * usize::from(area.columns) + usize::from(column);
        let mut sum = WeightedSum { at: [0; 3], normal: [0; 3] };
        let corner = self.add(&mut sum, first, WHOLE - right - below - both)?;
        if x > 0 {
            self.add(&mut sum, first + 1, right)?;
        }
        if y > 0 {
            let first = first + usize::from(area.columns);
            self.add(&mut sum, first, below)?;
            if x > 0 {
                self.add(&mut sum, first + 1, both)?;
            }
        }
        let WeightedSum { at, normal } = sum;
        Some(SurfacePoint { link: corner.link, at: at.map(micrometres), normal: unit(normal)? })
    }

    /// The point as of [`Table::spot`], and the region of the nearest taxel, see
    /// [`NO_REGION`](super::NO_REGION).
    pub(super) fn spot_in(
        &self,
        layout: &Layout,
        panel: u8,
        x: Fixed16,
        y: Fixed16,
    ) -> Option<(SurfacePoint, u8)> {
        let spot = self.spot(layout, panel, x, y)?;
        let area = layout.areas().get(usize::from(panel))?;
        let nearest = |at: Fixed16, count| {
            let (at, share) = within(at, count);
            usize::from(at) + usize::from(share >= 1 << 14)
        };
        let row = nearest(y, area.rows) * usize::from(area.columns);
        let taxel = self.taxels().get(usize::from(area.base) + row + nearest(x, area.columns))?;
        Some((spot, taxel.region))
    }

    /// Adds a taxel's place and normal with a weight.
    fn add(&self, sum: &mut WeightedSum, taxel: usize, weight: u32) -> Option<&TaxelRecord> {
        let taxel = self.taxels().get(taxel).filter(|taxel| taxel.is_placed())?;
        for (sum, from) in [(&mut sum.at, &taxel.at), (&mut sum.normal, &taxel.normal)] {
            for (sum, from) in sum.iter_mut().zip(from) {
                *sum = sum.wrapping_add(i32::from(*from).wrapping_mul(weight as i32));
            }
        }
        Some(taxel)
    }
}

/// Sums over taxels whose weights are [`WHOLE`] together: in units of 2^-30, below 2 in size.
struct WeightedSum {
    at: [i32; 3],
    normal: [i32; 3],
}

/// The taxel at or before a coordinate, and the share of the next one in units of 2^-15; limited to the
/// panel.
fn within(at: Fixed16, count: u16) -> (u16, u32) {
    let last = i32::from(count.saturating_sub(1)) << 16;
    let at = at.0.max(0).min(last);
    ((at >> 16) as u16, (at & 0xffff) as u32 >> 1)
}

/// Length, in units of 2^-15 squared, below which a vector has no direction: 1/16.
const SHORT: u32 = 1 << 22;
/// Remainder of the squared length, units of 2^-15, after which a vector is of length 1: then the rest is
/// 3/8 of its square, 6e-6.
const NEAR: i32 = 128;
/// Rounds that bring a vector of 1/16 to length 1: each makes it longer by half, or squares what is missing.
const ROUNDS: u32 = 12;

/// The direction of a vector in units of 2^-30; none if it is shorter than 1/16. Newton's iteration: a vector
/// of length l, near 1, becomes one of 1 by adding (1 - l^2) / 2 of it.
fn unit(mut vector: [i32; 3]) -> Option<UnitVector> {
    for _ in 0..ROUNDS {
        let near = vector.map(|x| (x >> 14).wrapping_add(1) >> 1);
        let square = near.iter().fold(0u32, |sum, x| sum.wrapping_add(x.wrapping_mul(*x) as u32));
        if square < SHORT {
            return None;
        }
        let missing = ((1i32 << 30).wrapping_sub_unsigned(square)) >> 15;
        for (x, near) in vector.iter_mut().zip(near) {
            *x = x.wrapping_add(near.wrapping_mul(missing) >> 1);
        }
        if missing.abs() < NEAR {
            break;
        }
    }
    Some(vector.map(|x| ((x >> 15).wrapping_add(1) >> 1) as i16))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_of_length_1() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        for _ in 0..100_000 {
            let vector = [next(), next(), next()];
            let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            let wanted = 0.0626 + 0.9379 * next().abs();
            let scaled = vector.map(|x| x / length * wanted * f64::from(1 << 30));
            let unit = unit(scaled.map(|x| x as i32)).unwrap();
            for (unit, x) in unit.iter().zip(vector) {
                let off = f64::from(*unit) / f64::from(1 << 14) - x / length;
                let most = if wanted > 0.9 { 7e-5 } else { 2e-4 };
                assert!(off.abs() < most, "{vector:?}, {wanted}: {off}");
            }
        }
        assert_eq!((unit([0; 3]), unit([1 << 25; 3])), (None, None));
    }
}
