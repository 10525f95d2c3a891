//! A contact of the robot, on one board or on several.

use super::touch::RobotTouch;
use taxel_core::contact::Phase;

/// A contact of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotContact {
    /// Number of its onset, from 1 upwards; constant from onset to release.
    pub id: u32,
    /// Onset, held or released.
    pub phase: Phase,
    /// Host time of its onset, us since 1970.
    pub onset_us: u64,
    /// What it is now.
    pub touch: RobotTouch,
}
