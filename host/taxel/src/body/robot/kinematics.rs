//! Forward kinematics: where the links are.

use super::model::{JointKind, Robot, RobotJoint};
use crate::body::pose::Pose;
use glam::DQuat;

/// Poses of a robot's links in one posture.
#[derive(Debug, Clone, PartialEq)]
pub struct Poses {
    /// Pose of each link in the base, in the order of [`Robot::links`].
    in_base: Vec<Pose>,
}

impl Robot {
    /// Poses of its links in a posture: the positions of [`Robot::free`], rad or m, within their limits or not.
    /// Positions that are left out count as 0.
    pub fn poses(&self, posture: &[f64]) -> Poses {
        let mut in_base = Vec::with_capacity(self.links.len());
        in_base.push(Pose::IDENTITY);
        for joint in &self.joints {
            let pose = in_base[joint.parent].then(&joint.pose(posture));
            in_base.push(pose);
        }
        Poses { in_base }
    }
}

impl RobotJoint {
    /// Pose of the child in the parent.
    fn pose(&self, posture: &[f64]) -> Pose {
        let position = self.drive.map_or(0.0, |drive| drive.position(posture));
        let motion = match self.kind {
            JointKind::Fixed => return self.origin,
            JointKind::Prismatic => Pose { at: self.axis * position, ..Pose::IDENTITY },
            JointKind::Revolute | JointKind::Continuous => {
                Pose { turn: DQuat::from_axis_angle(self.axis, position), ..Pose::IDENTITY }
            }
        };
        self.origin.then(&motion)
    }
}

impl Poses {
    /// Pose of a link in the frame of another, by their numbers: 0 is the base. None without such a link.
    pub fn of(&self, link: usize, frame: usize) -> Option<Pose> {
        Some(self.in_base.get(frame)?.inverse().then(self.in_base.get(link)?))
    }
}
