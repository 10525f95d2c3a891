//! Knowledge of the robot at a cycle.

use crate::body::DVec3;
use crate::mind::{BodyPlace, Mover};
use std::sync::Arc;
use taxel_core::intent::Leading;

/// A contact on the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionTouch {
    /// Number from onset to release, among all contacts of the robot.
    pub touch: u64,
    /// Its place on the body, by name.
    pub place: Arc<BodyPlace>,
    /// Number of its link among [`Robot::links`](crate::body::robot::Robot::links).
    pub link: usize,
    /// Place in the frame of the link, m.
    pub at: DVec3,
    /// Direction away from the robot there, in the frame of the link; of length 1.
    pub normal: DVec3,
    /// Force along the normal, N; what presses the robot is positive.
    pub newtons: f64,
    /// Whose motion has caused it.
    pub mover: Mover,
}

/// A posture, and when it was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPosture<'a> {
    /// Time at which it was measured, us, by the clock of the cycle.
    pub at_us: u64,
    /// Positions of [`Robot::free`](crate::body::robot::Robot::free), rad or m.
    pub positions: &'a [f64],
}

/// The state of a board.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MotionBoard {
    /// Start of its newest scan, us, by the clock of the cycle; none while it is not there.
    pub scanned_us: Option<u64>,
    /// Time between two scans, us.
    pub period_us: u32,
    /// Its forces are newtons: it has a calibration, or is simulated.
    pub is_calibrated: bool,
    /// Times that it has begun: more than before, if it has restarted or has another garment.
    pub begun: u32,
}

/// All that is known at a cycle.
#[derive(Debug, Clone, Copy)]
pub struct MotionInput<'a> {
    /// Time of the cycle, us.
    pub now_us: u64,
    /// The newest posture; none before the first.
    pub posture: Option<MotionPosture<'a>>,
    /// The boards, always in the same order.
    pub boards: &'a [MotionBoard],
    /// The present contacts of all boards.
    pub touches: &'a [MotionTouch],
    /// The meaning of touches to the robot.
    pub leading: Leading,
}
