//! Pose of a frame in another.

use glam::{DQuat, DVec3};
use taxel_core::surface;

/// Place and direction of one frame in another: rigid, so that it keeps lengths and angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Origin of the frame in the other, m.
    pub at: DVec3,
    /// Turns directions of the frame into those of the other; of length 1.
    pub turn: DQuat,
}

impl Pose {
    /// A pose from its origin, m, and a quaternion x, y, z, w of any length.
    pub fn from_arrays(at: [f64; 3], turn: [f64; 4]) -> Pose {
        Pose { at: DVec3::from(at), turn: DQuat::from_array(turn).normalize() }
    }

    /// The pose as a board takes it. Error if a number is not finite, or the origin is beyond 100 m along an
    /// axis.
    pub fn for_board(&self) -> Result<surface::Pose, &'static str> {
        if !self.at.to_array().iter().all(|m| m.abs() <= 100.0) {
            return Err("its origin must be within 100 m");
        }
        if !self.turn.is_finite() {
            return Err("its quaternion must have a length");
        }
        let one = f64::from(1 << 30);
        Ok(surface::Pose {
            at: self.at.to_array().map(|m| (m * 1e6).round() as i32),
            turn: self.turn.to_array().map(|part| (part * one).round() as i32),
        })
    }

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
