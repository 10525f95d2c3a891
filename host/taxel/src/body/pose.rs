//! Poses of links as a board takes them.

use glam::DQuat;
use taxel_core::surface::Pose;

/// The pose of a link for a board: its origin, m, and its rotation as a quaternion x, y, z, w, of any length but
/// 0. Error if a number is not finite, the origin is beyond 100 m along an axis, or the quaternion is 0.
pub fn pose(at: [f64; 3], turn: [f64; 4]) -> Result<Pose, &'static str> {
    if !at.iter().all(|m| m.abs() <= 100.0) {
        return Err("its origin must be within 100 m");
    }
    let turn = DQuat::from_array(turn).normalize();
    if !turn.is_finite() {
        return Err("its quaternion must have a length");
    }
    let one = f64::from(1 << 30);
    Ok(Pose {
        at: at.map(|m| (m * 1e6).round() as i32),
        turn: turn.to_array().map(|part| (part * one).round() as i32),
    })
}
