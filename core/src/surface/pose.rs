//! Poses of links, as a host sends them, and points and directions in another frame.

use super::{Micrometres, UnitVector};
use crate::format::{Invalid, signed_wide};
use serde::{Deserialize, Serialize};

/// A rotation as a quaternion x, y, z, w in units of 2^-30.
pub type Quaternion = [i32; 4];

/// Pose of a link: where it is and how it is turned in the frame in which contacts are told.
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

/// A checked pose: rotation matrix in units of 2^-30, row by row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rigid {
    at: Micrometres,
    rows: [[i32; 3]; 3],
}

impl Pose {
    /// The pose of a link in its own frame.
    pub const OWN: Pose = Pose { at: [0; 3], turn: [0, 0, 0, 1 << BITS] };

    /// Checks the pose, and computes its matrix. Error if the origin is farther than 100 m along an axis, or
    /// the quaternion's length is not 1.
    pub(crate) fn build(&self) -> Result<Rigid, Invalid> {
        if self.at.iter().any(|um| um.unsigned_abs() > FAR_UM) {
            return Err(Invalid { parameter: "pose.at", must: "must be within 100 m" });
        }
        let off = Invalid { parameter: "pose.turn", must: "must be a quaternion of length 1" };
        if self.turn.iter().any(|part| part.unsigned_abs() > 1 << BITS | 1 << 10) {
            return Err(off);
        }
        // Twice the products, in units of 2^-30: each at most half a unit off.
        let twice = |a: i32, b: i32| {
            let product = i64::from(a) * i64::from(b);
            (product + (1 << (BITS - 2))) >> (BITS - 1)
        };
        let [x, y, z, w] = self.turn;
        let [xx, yy, zz, ww] = [x, y, z, w].map(|part| twice(part, part));
        let one = 1i64 << BITS;
        if (xx + yy + zz + ww).abs_diff(2 * one) > OFF {
            return Err(off);
        }
        let [xy, xz, yz] = [twice(x, y), twice(x, z), twice(y, z)];
        let [wx, wy, wz] = [twice(w, x), twice(w, y), twice(w, z)];
        let rows = [
            [one - yy - zz, xy - wz, xz + wy],
            [xy + wz, one - xx - zz, yz - wx],
            [xz - wy, yz + wx, one - xx - yy],
        ];
        Ok(Rigid { at: self.at, rows: rows.map(|row| row.map(|entry| entry as i32)) })
    }
}

impl Rigid {
    /// A direction or force turned into the frame; at most 1 unit off.
    pub fn turned(&self, vector: [i32; 3]) -> [i32; 3] {
        self.rows.map(|row| {
            let sum: i64 = row.iter().zip(vector).map(|(entry, x)| product(*entry, x)).sum();
            ((sum + (1 << (BITS - 1))) >> BITS) as i32
        })
    }

    /// A direction turned into the frame.
    pub fn directed(&self, direction: UnitVector) -> UnitVector {
        let [x, y, z] = self.turned(direction.map(i32::from));
        [x, y, z].map(|x| x.clamp(i16::MIN.into(), i16::MAX.into()) as i16)
    }

    /// A point of the link in the frame, micrometres: at most 4 um off for points within 2 m of the origin.
    pub fn placed(&self, at: Micrometres) -> Micrometres {
        let ([x, y, z], [dx, dy, dz]) = (self.turned(at), self.at);
        [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)]
    }
}

/// Product of two signed words.
fn product(a: i32, b: i32) -> i64 {
    let size = signed_wide(a, b.unsigned_abs() & (u32::MAX >> 1));
    if b < 0 { -size } else { size }
}
