//! A robot: links, and the joints between them.

use crate::body::pose::Pose;
use glam::DVec3;
use std::ops::RangeInclusive;

/// A robot, read from a URDF by [`parse`](super::parse) or [`read`](super::read).
///
/// Links are numbered from 0, the root, each after its parent. Each other link hangs on one joint: link `i` on
/// joint `i - 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    pub(super) file: String,
    pub(super) links: Vec<RobotLink>,
    pub(super) joints: Vec<RobotJoint>,
    pub(super) free: Vec<usize>,
}

/// A link.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotLink {
    /// Name of the link.
    pub name: String,
    /// Line of the file.
    pub line: usize,
}

/// A joint.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotJoint {
    /// Name of the joint.
    pub name: String,
    /// Line of the file.
    pub line: usize,
    /// Kind of its motion.
    pub kind: JointKind,
    /// Number of the link that it hangs on.
    pub parent: usize,
    /// Pose of the child's frame in the parent's at position 0.
    pub origin: Pose,
    /// Direction about which it turns or along which it slides, in the child's frame; of length 1.
    pub axis: DVec3,
    /// Least and greatest position, rad or m.
    pub limits: Option<RangeInclusive<f64>>,
    /// Greatest velocity, rad/s or m/s, if the file states one.
    pub velocity: Option<f64>,
    /// Source of its position; none if it is fixed.
    pub drive: Option<Drive>,
}

/// Kind of a joint's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// No motion.
    Fixed,
    /// Turns between limits, rad.
    Revolute,
    /// Turns on and on, rad: positions a whole turn apart are the same.
    Continuous,
    /// Slides between limits, m.
    Prismatic,
}

/// Position of a joint: `multiplier * q + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Number of `q` among the positions of [`Robot::free`]: the joint's own, or of the one that it mimics.
    pub free: usize,
    /// 1 for a joint with a position of its own.
    pub multiplier: f64,
    /// Offset in the joint's unit, rad or m; 0 for a joint with a position of its own.
    pub offset: f64,
}

impl Robot {
    /// File that it was read from, or name of the preset.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Returns its links; the first is the root, whose frame is the base.
    pub fn links(&self) -> &[RobotLink] {
        &self.links
    }

    /// Returns its joints: joint `i` carries link `i + 1`.
    pub fn joints(&self) -> &[RobotJoint] {
        &self.joints
    }

    /// Numbers of the joints with a position of their own: those that move and mimic no other. A posture is a
    /// list of their positions in this order, in rad or m.
    pub fn free(&self) -> &[usize] {
        &self.free
    }

    /// Number of the link that a link hangs on; none for the root.
    pub(super) fn parent(&self, link: usize) -> Option<usize> {
        Some(self.joints.get(link.checked_sub(1)?)?.parent)
    }
}

impl Drive {
    /// Position of the joint in a posture, rad or m. What the posture lacks counts as 0.
    pub(in crate::body) fn position(&self, posture: &[f64]) -> f64 {
        self.multiplier * posture.get(self.free).copied().unwrap_or(0.0) + self.offset
    }

    /// The most by which it is off if the posture is, rad or m.
    pub(in crate::body) fn error(&self, errors: &[f64]) -> f64 {
        match self.multiplier {
            // The posture's error may be infinite.
            0.0 => 0.0,
            multiplier => multiplier.abs() * errors.get(self.free).copied().unwrap_or(0.0),
        }
    }
}
