//! Poses of links, as a host sends them, and points and directions in another frame.

use super::{Micrometres, UnitVector};
use crate::format::Invalid;
use serde::{Deserialize, Serialize};

/// A rotation as a quaternion x, y, z, w in units of 2^-30.
pub type Quaternion = [i32; 4];

/// Pose of a link: where it is and how it is turned in the frame in which contacts are reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pose {
    /// The link's origin in that frame.
    pub at: Micrometres,
    /// Rotation from the link's axes to that frame's.
    pub turn: Quaternion,
}

/// Greatest distance of an origin along an axis: 100 m.
const FAR_UM: u32 = 100_000_000;
/// Most by which a quaternion's square may differ from 1, units of 2^-30: a turned vector is longer or
/// shorter by less than two millionths.
const OFF: u64 = 1024;
/// Bits after the point of a quaternion.
const BITS: u32 = 30;

/// A checked pose: rotation matrix row by row, in units of 2^-20, in which a row moves a vector of 2 m by at
/// most 2 um.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rigid {
    at: Micrometres,
    rows: [[i32; 3]; 3],
}

/// Bits after the point of a matrix.
const ROW_BITS: u32 = 20;
/// Bits of the lower part of a component, whose products with a row fit in 31 bits.
const LOW_BITS: u32 = 11;

impl Pose {
    /// The pose of a link in its own frame.
    pub const OWN: Pose = Pose { at: [0; 3], turn: [0, 0, 0, 1 << BITS] };

    /// Checks the pose. Error if the origin is farther than 100 m along an axis, or the quaternion's length
    /// is not 1.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        if self.at.iter().any(|um| um.unsigned_abs() > FAR_UM) {
            return Err(Invalid { parameter: "pose.at", must: "must be within 100 m" });
        }
        let off = Invalid { parameter: "pose.turn", must: "must be a quaternion of length 1" };
        if self.turn.iter().any(|part| part.unsigned_abs() > 1 << BITS | 1 << 10) {
            return Err(off);
        }
        let square: i64 = self.turn.iter().map(|part| twice(*part, *part)).sum();
        if square.abs_diff(2 << BITS) > OFF { Err(off) } else { Ok(()) }
    }

    /// The matrix of a pose whose quaternion is of length 1.
    pub(crate) fn matrix(&self) -> Rigid {
        let [x, y, z, w] = self.turn;
        let [xx, yy, zz] = [x, y, z].map(|part| twice(part, part));
        let one = 1i64 << BITS;
        let [xy, xz, yz] = [twice(x, y), twice(x, z), twice(y, z)];
        let [wx, wy, wz] = [twice(w, x), twice(w, y), twice(w, z)];
        let rows = [
            [one - yy - zz, xy - wz, xz + wy],
            [xy + wz, one - xx - zz, yz - wx],
            [xz - wy, yz + wx, one - xx - yy],
        ];
        let rounded = |entry: i64| (entry as i32 + (1 << (BITS - ROW_BITS - 1))) >> (BITS - ROW_BITS);
        Rigid { at: self.at, rows: rows.map(|row| row.map(rounded)) }
    }
}

/// Twice a product, in units of 2^-30: at most half a unit off.
fn twice(a: i32, b: i32) -> i64 {
    let product = i64::from(a) * i64::from(b);
    (product + (1 << (BITS - 2))) >> (BITS - 1)
}

impl Rigid {
    /// A vector of less than 2^21 units in each component turned into the frame; at most 3 units off. A
    /// longer one is rounded to as many bits as fit.
    pub fn turned(&self, mut vector: [i32; 3]) -> [i32; 3] {
        let mut shift = 0;
        while vector.iter().fold(0, |all, x| all | (x ^ x >> 31)) >> (ROW_BITS + 1) != 0 {
            vector = vector.map(|x| x >> 1);
            shift += 1;
        }
        // In 32 bits: the upper 11 bits of all components with a row are below sqrt(3) 2^30.
        self.rows.map(|row| {
            let mut sum = 1i32 << (ROW_BITS - LOW_BITS - 1);
            for (entry, x) in row.iter().zip(vector) {
                let low = x & ((1 << LOW_BITS) - 1);
                sum = sum.wrapping_add((x >> LOW_BITS).wrapping_mul(*entry));
                sum = sum.wrapping_add(low.wrapping_mul(*entry) >> LOW_BITS);
            }
            (sum >> (ROW_BITS - LOW_BITS)) << shift
        })
    }

    /// A direction turned into the frame.
    pub fn directed(&self, direction: UnitVector) -> UnitVector {
        self.turned(direction.map(i32::from)).map(|x| x as i16)
    }

    /// A point of the link in the frame, micrometres: at most 4 um off for points within 2 m of the origin.
    pub fn placed(&self, at: Micrometres) -> Micrometres {
        let ([x, y, z], [dx, dy, dz]) = (self.turned(at), self.at);
        [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)]
    }
}
