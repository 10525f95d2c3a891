//! Commands to the robot at a cycle, and their causes.

use super::config::TouchAction;
use super::guard::MotionFault;
use crate::mind::BodyPlace;
use std::sync::Arc;

/// Whether commands are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionPhase {
    /// Nobody has armed it: it says nothing.
    Disarmed,
    /// Commands are given.
    Armed,
    /// A fault has stopped it: the robot stands still until it is armed again.
    Stopped,
}

/// Deed of a cycle, above single touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionDeed {
    /// Nothing is commanded.
    Nothing,
    /// A fault, or a row, stops the robot.
    Stop,
    /// Two touches oppose each other: the robot stands still.
    Clamped,
    /// The robot moves away from what presses.
    Retreat,
    /// The robot is led by hand.
    Yield,
    /// Its own motion is slowed down.
    Slow,
    /// Its own motion returns to full speed.
    Resume,
    /// The robot moves by itself, at full speed.
    Free,
}

impl MotionPhase {
    /// Its name, as JSON has it.
    pub fn as_str(self) -> &'static str {
        match self {
            MotionPhase::Disarmed => "disarmed",
            MotionPhase::Armed => "armed",
            MotionPhase::Stopped => "stopped",
        }
    }
}

impl MotionDeed {
    /// Its name, as JSON has it.
    pub fn as_str(self) -> &'static str {
        match self {
            MotionDeed::Nothing => "nothing",
            MotionDeed::Stop => "stop",
            MotionDeed::Clamped => "clamped",
            MotionDeed::Retreat => "retreat",
            MotionDeed::Yield => "yield",
            MotionDeed::Slow => "slow",
            MotionDeed::Resume => "resume",
            MotionDeed::Free => "free",
        }
    }
}

/// A touch and what is done about it.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionCause {
    /// Number of the touch.
    pub touch: u64,
    /// Its place on the body.
    pub place: Arc<BodyPlace>,
    /// Its force, N; the greatest so far of a touch that has ended.
    pub newtons: f64,
    /// The action about it.
    pub action: TouchAction,
    /// Number of the row of `when` that says so, from 0; none: a limit of force is near.
    pub row: Option<usize>,
}

/// A command.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionCommand {
    /// Whether it is one.
    pub phase: MotionPhase,
    /// The deed.
    pub deed: MotionDeed,
    /// The fault that has stopped it.
    pub fault: Option<MotionFault>,
    /// Factor on the speed of the robot's own motion, 0 to 1; none while it is disarmed.
    pub speed: Option<f64>,
    /// Velocities of [`Robot::free`](crate::body::robot::Robot::free), rad/s or m/s; 0 unless it is armed.
    pub velocities: Vec<f64>,
    /// Energy that is left in the tank, J.
    pub tank_j: f64,
    /// The tank or a pair of links has cut the velocities, to this share.
    pub share: f64,
    /// The touches about which something is done.
    pub causes: Vec<MotionCause>,
}

impl MotionCommand {
    /// True if a joint is to move.
    pub fn moves(&self) -> bool {
        self.velocities.iter().any(|velocity| *velocity != 0.0)
    }
}
