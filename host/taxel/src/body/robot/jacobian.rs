//! Jacobians: how the velocities of the joints move a link.

use super::kinematics::Poses;
use super::model::{JointKind, Robot};
use glam::DVec3;

impl Robot {
    /// Velocity of a point of a link for a velocity of 1 rad/s or 1 m/s of each of [`Robot::free`], all in the base:
    /// m/rad, or m/m of a joint that slides. `at` is the point in the base, m. Columns of joints that do not carry the
    /// link are 0, and all of a link that the robot does not have.
    pub fn jacobian(&self, poses: &Poses, link: usize, at: DVec3) -> Vec<DVec3> {
        self.columns(poses, link, |kind, axis, origin| match kind {
            JointKind::Fixed => DVec3::ZERO,
            JointKind::Prismatic => axis,
            JointKind::Revolute | JointKind::Continuous => axis.cross(at - origin),
        })
    }

    /// Angular velocity of a link, rad/s, for a velocity of 1 of each of [`Robot::free`], in the base.
    pub fn turning(&self, poses: &Poses, link: usize) -> Vec<DVec3> {
        self.columns(poses, link, |kind, axis, _| match kind {
            JointKind::Fixed | JointKind::Prismatic => DVec3::ZERO,
            JointKind::Revolute | JointKind::Continuous => axis,
        })
    }

    /// The column of each joint with a position of its own, from the kind, the axis and the origin in the base of the
    /// joints between a link and the root that it drives.
    fn columns(
        &self,
        poses: &Poses,
        link: usize,
        of: impl Fn(JointKind, DVec3, DVec3) -> DVec3,
    ) -> Vec<DVec3> {
        let mut columns = vec![DVec3::ZERO; self.free.len()];
        let mut child = link;
        while let Some(joint) = child.checked_sub(1).and_then(|number| self.joints.get(number)) {
            if let (Some(drive), Some(pose)) = (joint.drive, poses.of(child, 0))
                && let Some(column) = columns.get_mut(drive.free)
            {
                *column += drive.multiplier * of(joint.kind, pose.direction(joint.axis), pose.at);
            }
            child = joint.parent;
        }
        columns
    }
}
