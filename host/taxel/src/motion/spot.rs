//! A place of the robot's surface in a posture.

use crate::body::DVec3;
use crate::body::robot::{Poses, Robot};

/// A place of a link, and how the joints move it.
#[derive(Debug, Clone)]
pub(super) struct TouchedSpot {
    /// Place in the base, m.
    pub at: DVec3,
    /// Direction away from the robot in the base.
    pub normal: DVec3,
    /// Velocity of the place for a velocity of 1 of each joint.
    pub columns: Vec<DVec3>,
}

impl TouchedSpot {
    /// A place and a direction of a link, in its frame; none without such a link.
    pub fn of(robot: &Robot, poses: &Poses, link: usize, at: DVec3, normal: DVec3) -> Option<TouchedSpot> {
        let pose = poses.of(link, 0)?;
        let at = pose.point(at);
        let columns = robot.jacobian(poses, link, at);
        Some(TouchedSpot { at, normal: pose.direction(normal), columns })
    }

    /// Its velocity in the base, m/s.
    pub fn velocity(&self, velocities: &[f64]) -> DVec3 {
        self.columns.iter().zip(velocities).map(|(column, velocity)| *column * *velocity).sum()
    }
}
