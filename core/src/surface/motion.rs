//! Links that move: their poses between the host's messages.
//!
//! A host that knows how the links move says so with their poses, and how far off they may be then. A board
//! does not wait for the next poses: it carries each link on with its velocity and its spin, and says how far
//! off a place on it may be.

use super::Micrometres;
use super::pose::{Pose, Quaternion, Rigid};
use crate::format::{Invalid, Micros};
use serde::{Deserialize, Serialize};

/// Motion of a link at the time of its pose, in the frame in which contacts are reported.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkMotion {
    /// Velocity of its origin, um/s.
    pub velocity: [i32; 3],
    /// Angular velocity, 2^-20 rad/s.
    pub spin: [i32; 3],
    /// The most by which a place on the link is off at the time of the pose, um.
    pub error: u32,
    /// The most by which it moves otherwise from then on: um/s, and um/s^2.
    pub drift: u32,
    /// See `drift`.
    pub acceleration: u32,
}

/// Longest time for which a pose is carried on, us. Older ones are not used: nothing is reported in their
/// frame.
pub const CARRIED_US: u32 = 200_000;

/// Most of each number of a motion: 100 m/s, 128 rad/s, and 1 km/s^2 of acceleration.
const FASTEST_UM: u32 = 100_000_000;
const FASTEST_SPIN: u32 = 1 << 27;
const MOST_UM: u32 = 1_000_000_000;
/// Most by which the board's arithmetic moves a place, um; with that of the surface's table.
const ROUNDED_UM: u32 = 60;

/// 1.0 of a quaternion and of an angle.
const ONE: i64 = 1 << 30;

impl LinkMotion {
    /// Checks the motion. Error if a number is beyond what moves on a robot.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        let size = |vector: &[i32; 3]| vector.iter().map(|x| x.unsigned_abs()).max().unwrap_or(0);
        let is_sane = size(&self.velocity) <= FASTEST_UM
            && size(&self.spin) <= FASTEST_SPIN
            && self.error <= MOST_UM
            && self.drift <= MOST_UM
            && self.acceleration <= MOST_UM;
        let must = "must be below 100 m/s and 128 rad/s, its errors below 1 km";
        if is_sane { Ok(()) } else { Err(Invalid { parameter: "pose.motion", must }) }
    }

    /// Returns where a link is `us` after its pose, at most [`CARRIED_US`] before or after it, and the most by
    /// which a place on it is off, um. None if it turns by more than 1 rad in that time.
    #[inline(never)] // M0+: out of line
    pub(crate) fn carry(&self, pose: &Pose, us: i32) -> Option<(Rigid, u32)> {
        // Seconds in units of 2^-24.
        let seconds = (i64::from(us) * 17_592_186 / (1 << 20)) as i32;
        let times = |rate: i32| (i64::from(rate) * i64::from(seconds)) >> 24;
        let mut at: Micrometres = pose.at;
        for (at, velocity) in at.iter_mut().zip(self.velocity) {
            *at = at.saturating_add(times(velocity) as i32);
        }
        // The turn in units of 2^-30 rad.
        let angle = self.spin.map(|spin| times(spin) << 10);
        if angle.iter().any(|angle| angle.abs() > ONE) {
            return None;
        }
        let square: i64 = angle.iter().map(|angle| (angle * angle) >> 30).sum();
        if square > ONE {
            return None;
        }
        let turn = turned(pose.turn, angle, square);
        let long = i64::from(seconds).abs();
        let moved = ((i64::from(self.drift) * long) >> 24)
            + ((((i64::from(self.acceleration) * long) >> 24) * long) >> 25);
        let off = u64::from(self.error) + moved.unsigned_abs() + u64::from(ROUNDED_UM);
        Some((Pose { at, turn }.matrix(), u32::try_from(off).unwrap_or(u32::MAX)))
    }
}

/// A rotation followed by one about `angle`, 2^-30 rad, whose squared length is `square`.
fn turned([x, y, z, w]: Quaternion, angle: [i64; 3], square: i64) -> Quaternion {
    // sin(a / 2) / a and cos(a / 2) by their series; what is left out is below 2^-24 at 1 rad.
    let half = less::<24>(square, less::<80>(square, less::<168>(square, ONE))) >> 1;
    let whole = less::<8>(square, less::<48>(square, less::<120>(square, ONE)));
    let [a, b, c] = angle.map(|angle| (angle * half) >> 30);
    let [x, y, z, w] = [x, y, z, w].map(i64::from);
    let sum = |terms: [i64; 4]| ((terms.iter().sum::<i64>() + (1 << 29)) >> 30) as i32;
    [
        sum([whole * x, a * w, b * z, -c * y]),
        sum([whole * y, b * w, c * x, -a * z]),
        sum([whole * z, c * w, a * y, -b * x]),
        sum([whole * w, -a * x, -b * y, -c * z]),
    ]
}

/// `1 - square * factor / BY`: a step of a series.
const fn less<const BY: i64>(square: i64, factor: i64) -> i64 {
    ONE - ((square * factor) >> 30) / BY
}

/// Time from one moment to another, us; none if it is longer than poses are carried on.
pub(super) fn between(from: Micros, to: Micros) -> Option<i32> {
    let us = to.0.wrapping_sub(from.0) as i64;
    (us.unsigned_abs() <= CARRIED_US.into()).then_some(us as i32)
}
