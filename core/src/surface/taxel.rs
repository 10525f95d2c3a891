//! A taxel's entry in the table.

use super::{ONE, UnitVector};
use crate::format::root;
use bytemuck::{Pod, Zeroable};

/// Number of a link that stands for none: the taxel has no place.
pub(super) const NOWHERE: u16 = u16::MAX;

/// A taxel on the robot, as it lies in flash: 20 bytes, little-endian. Lengths are in units of 2^-14 m (61
/// um), so that every coordinate is below 2 m; rounding moves a taxel by at most 53 um.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct TaxelRecord {
    /// Index of its link in the table; 65535: it has no place, and all that follows is 0.
    pub link: u16,
    /// Its centre in the frame of the link.
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
    pub const NOWHERE: TaxelRecord = TaxelRecord { link: NOWHERE, at: [0; 3], normal: [0; 3], arm: [0; 3] };

    /// True if it has a place.
    pub const fn is_placed(&self) -> bool {
        self.link != NOWHERE
    }

    /// Condition that the entry breaks, if any: for a table of `links` links.
    pub(super) fn fault(&self, links: u16) -> Option<&'static str> {
        if !self.is_placed() {
            let rest = [self.at, self.normal, self.arm];
            return (rest != [[0; 3]; 3]).then_some("must be all zero for a taxel without a place");
        }
        if self.link >= links {
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
