//! A taxel's entry in the table.

use super::{Micrometres, ONE, UnitVector};
use crate::format::root;
use bytemuck::{Pod, Zeroable};

/// Number of a link that stands for none: the taxel has no place.
pub(super) const NOWHERE: u8 = u8::MAX;
/// Number of a region that stands for none.
pub const NO_REGION: u8 = u8::MAX;

/// A taxel on the robot, as it lies in flash: 20 bytes, little-endian. Lengths are in units of 2^-14 m (61
/// um), so that every coordinate is below 2 m; rounding moves a taxel by at most 53 um.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C, align(4))]
pub struct TaxelRecord {
    /// Index of its link in the table; 255: it has no place, and all vectors are 0.
    pub link: u8,
    /// Index of its region in the table; [`NO_REGION`]: it is in none.
    pub region: u8,
    /// Centre in the frame of the link.
    pub at: [i16; 3],
    /// Direction away from the robot.
    pub normal: UnitVector,
    /// `at x normal`: the moment about the link's origin of a force of 1 along the normal.
    pub arm: [i16; 3],
}

/// Most by which the length of a normal may differ from 1, and by which an arm may differ from that of the
/// rounded place and normal, units of 2^-14.
const OFF: i32 = 8;

impl TaxelRecord {
    /// A taxel without a place.
    pub const NOWHERE: TaxelRecord =
        TaxelRecord { link: NOWHERE, region: NO_REGION, at: [0; 3], normal: [0; 3], arm: [0; 3] };

    /// Returns its centre in the frame of the link, um.
    pub(super) fn at(&self) -> Micrometres {
        self.at.map(|x| micrometres(i32::from(x) << 16))
    }

    /// True if it has a place.
    pub const fn is_placed(&self) -> bool {
        self.link != NOWHERE
    }

    /// Condition that the entry breaks, if any: for a table of so many links and regions.
    pub(super) fn fault(&self, links: usize, regions: usize) -> Option<&'static str> {
        if self.region != NO_REGION && usize::from(self.region) >= regions {
            return Some("must name a region of the table");
        }
        if !self.is_placed() {
            let rest = [self.at, self.normal, self.arm];
            return (rest != [[0; 3]; 3]).then_some("must be all zero for a taxel without a place");
        }
        if usize::from(self.link) >= links {
            return Some("must name a link of the table");
        }
        let length = root(self.normal.iter().map(|n| u64::from(n.unsigned_abs()).pow(2)).sum());
        if length.abs_diff(ONE.unsigned_abs().into()) > OFF.unsigned_abs() {
            return Some("must have normals of length 1");
        }
        let [[x, y, z], [nx, ny, nz], arm] = [self.at, self.normal, self.arm].map(|v| v.map(i64::from));
        let cross = [y * nz - z * ny, z * nx - x * nz, x * ny - y * nx];
        let wrong =
            cross.iter().zip(arm).any(|(cross, arm)| (cross - (arm << 14)).abs() > i64::from(OFF) << 14);
        wrong.then_some("must have the arms that follow from places and normals")
    }
}

/// 2^-30 m to micrometres: at most 1 um off.
pub(super) fn micrometres(fine: i32) -> i32 {
    // Units of 2^-20 m, of which a micrometre is 1 - 759 / 2^14.
    let near = (fine >> 9).wrapping_add(1) >> 1;
    near - ((near * 759 + (1 << 13)) >> 14)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn micrometres_are_at_most_one_off() {
        for fine in (i32::MIN..=i32::MAX).step_by(7919).chain([i32::MIN, -1, 0, 1, i32::MAX]) {
            let exact = f64::from(fine) / f64::from(1 << 30) * 1e6;
            assert!((f64::from(micrometres(fine)) - exact).abs() <= 1.0, "{fine}");
        }
    }
}
