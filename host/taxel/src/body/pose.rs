//! Where a frame is in another.

use glam::{DQuat, DVec3};

/// Place and direction of one frame in another: rigid, so that it keeps lengths and angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Origin of the frame in the other, m.
    pub at: DVec3,
    /// Turns directions of the frame into those of the other; of length 1.
    pub turn: DQuat,
}

impl Pose {
    /// Both frames are the same.
    pub const IDENTITY: Pose = Pose { at: DVec3::ZERO, turn: DQuat::IDENTITY };

    /// A pose as a URDF writes it: `xyz` in metres; `rpy` in radians about the fixed axes x, then y, then z.
    pub fn from_xyz_rpy(xyz: DVec3, rpy: DVec3) -> Pose {
        let turn =
            DQuat::from_rotation_z(rpy.z) * DQuat::from_rotation_y(rpy.y) * DQuat::from_rotation_x(rpy.x);
        Pose { at: xyz, turn }
    }

    /// A point of the frame in the other, m.
    pub fn point(&self, at: DVec3) -> DVec3 {
        self.at + self.turn * at
    }

    /// A direction of the frame in the other; also a force.
    pub fn direction(&self, direction: DVec3) -> DVec3 {
        self.turn * direction
    }

    /// Pose of a third frame in the other, by its pose `inner` in this one.
    pub fn then(&self, inner: &Pose) -> Pose {
        Pose { at: self.point(inner.at), turn: (self.turn * inner.turn).normalize() }
    }

    /// Pose of the other frame in this one.
    pub fn inverse(&self) -> Pose {
        let turn = self.turn.conjugate();
        Pose { at: -(turn * self.at), turn }
    }
}
