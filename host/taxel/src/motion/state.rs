//! Memory of motion from one cycle to the next.

use super::command::MotionPhase;
use super::guard::{MotionFault, SeenCycle};
use super::known::RecentTouch;
use super::tank::Tank;
use super::yielding::Led;
use crate::body::DVec3;

/// Memory of [`MotionControl`](super::MotionControl). Begins disarmed.
#[derive(Debug, Clone)]
pub struct MotionState {
    pub(super) phase: MotionPhase,
    pub(super) fault: Option<MotionFault>,
    pub(super) counts: [u64; MotionFault::ALL.len()],
    /// Observations of the last cycle.
    pub(super) seen: Option<SeenCycle>,
    pub(super) known: Vec<RecentTouch>,
    pub(super) retreats: Vec<Retreat>,
    pub(super) led: Vec<Led>,
    /// The last command.
    pub(super) velocities: Vec<f64>,
    pub(super) speed: f64,
    /// Time at which something kept the robot's own motion as slow as it was, us.
    pub(super) slowed_us: u64,
    /// Time until which it is clamped, us.
    pub(super) clamped_us: u64,
    pub(super) tank: Tank,
}

/// A motion away from a touch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Retreat {
    pub touch: u64,
    pub link: usize,
    /// Place in the link's frame, m, and direction away from the robot there.
    pub at: DVec3,
    pub normal: DVec3,
    /// Time until which it lasts, us.
    pub until_us: u64,
}

impl MotionState {
    /// Disarmed, with this much in the tank, J.
    pub(super) fn new(joints: usize, tank_j: f64) -> MotionState {
        MotionState {
            phase: MotionPhase::Disarmed,
            fault: None,
            counts: [0; MotionFault::ALL.len()],
            seen: None,
            known: Vec::new(),
            retreats: Vec::new(),
            led: Vec::new(),
            velocities: vec![0.0; joints],
            speed: 1.0,
            slowed_us: 0,
            clamped_us: 0,
            tank: Tank::full(tank_j),
        }
    }

    /// Whether it commands.
    pub fn phase(&self) -> MotionPhase {
        self.phase
    }

    /// The fault that has stopped it, until it is armed again.
    pub fn fault(&self) -> Option<MotionFault> {
        self.fault
    }

    /// Times that a fault has stopped it.
    pub fn count(&self, fault: MotionFault) -> u64 {
        self.counts[fault as usize]
    }

    /// Disarms it: it says nothing more. Whoever moves the robot has it.
    pub fn disarm(&mut self) {
        (self.phase, self.fault) = (MotionPhase::Disarmed, None);
        self.stand();
    }

    /// Stops it because of a fault.
    pub(super) fn stop(&mut self, fault: MotionFault) {
        (self.phase, self.fault) = (MotionPhase::Stopped, Some(fault));
        self.counts[fault as usize] += 1;
        self.stand();
    }

    /// Nothing moves from now on.
    pub(super) fn stand(&mut self) {
        self.velocities.fill(0.0);
        self.retreats.clear();
        self.led.clear();
    }
}
