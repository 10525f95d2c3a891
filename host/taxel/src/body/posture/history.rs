//! Postures over time.

use super::motion::Motion;
use super::track::{At, Bounded, JointTrack};
use crate::body::robot::Robot;
use crate::error::{Result, RobotError};
use std::sync::Arc;
use std::time::Duration;
use taxel_core::format::Micros;

/// Readings kept of each joint: 10 s at 50 Hz, half a second at 1 kHz.
const KEPT: usize = 512;

/// Positions of a robot's joints with the board's times, and the posture at the time of a frame.
///
/// Readings may come late, in any order and joint by joint. Memory is bounded: of each joint the newest 512
/// are kept. A joint that turns on and on shows no whole turns: between readings so far apart that it may
/// have turned by half a turn, it is taken to be where the nearer one says, and the bound of the error is as
/// wide.
#[derive(Debug, Clone)]
pub struct JointHistory {
    robot: Arc<Robot>,
    tracks: Vec<JointTrack>,
    is_needed: Vec<bool>,
}

/// A posture at a time, and how exactly it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Positions of [`Robot::free`], rad or m. Joints that are not needed are at rest.
    pub posture: Vec<f64>,
    /// The most by which each is off, rad or m: infinite for joints that are not needed.
    pub errors: Vec<f64>,
    /// Time since the last reading of the joint whose last one is oldest; 0 where it lies between readings.
    pub age: Duration,
}

/// Reason why there is no posture of a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gap {
    /// A joint has no reading yet of that time or later: it may still come.
    Waits {
        /// Number of the joint.
        joint: usize,
        /// Time that has passed since.
        waited: Duration,
    },
    /// The readings that are kept of a joint begin later: the posture of that time never comes.
    Gone {
        /// Number of the joint.
        joint: usize,
    },
    /// A joint has fewer than two readings, and so no velocity.
    Unmoved {
        /// Number of the joint.
        joint: usize,
    },
}

impl JointHistory {
    /// A history without readings, whose postures need all joints. `motion` bounds their errors.
    pub fn new(robot: Arc<Robot>, motion: Motion) -> Result<JointHistory> {
        motion.check()?;
        let joints = robot.free().iter().filter_map(|joint| robot.joints().get(*joint));
        let tracks: Vec<JointTrack> = joints.map(|joint| JointTrack::new(joint, &motion, KEPT)).collect();
        let is_needed = vec![true; tracks.len()];
        Ok(JointHistory { robot, tracks, is_needed })
    }

    /// Needs these of [`Robot::free`] alone: those that move the links of a garment
    /// ([`RobotSurface::moving`](crate::body::RobotSurface::moving)). Nobody may send those of the legs.
    pub fn need(&mut self, free: &[usize]) {
        self.is_needed = (0..self.tracks.len()).map(|number| free.contains(&number)).collect();
    }

    /// Takes positions of joints, rad or m, at the board's time. Joints that are fixed or mimic others are
    /// passed over. Nothing is taken if the robot has no such joint, or a position is not a number or farther
    /// beyond a limit than a fiftieth of the joint's range.
    pub fn take<'a>(
        &mut self,
        at: Micros,
        positions: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<(), RobotError> {
        let mut checked = Vec::new();
        for (name, position) in positions {
            let joint = self.robot.joint(name)?;
            let Some(free) = self.robot.free().iter().position(|free| *free == joint) else { continue };
            self.robot.check_measured(free, position)?;
            checked.push((free, position));
        }
        for (free, position) in checked {
            self.tracks[free].take(at.0, position);
        }
        Ok(())
    }

    /// Forgets all readings: the board has restarted, and with it its clock.
    pub fn forget(&mut self) {
        self.tracks.iter_mut().for_each(JointTrack::clear);
    }

    /// The posture at a time, from readings on both sides of it. `now` is the board's time, for how long has
    /// been waited.
    pub fn aligned(&self, at: Micros, now: Micros) -> Result<Estimate, Gap> {
        self.estimate(|joint, track| match track.at(at.0) {
            At::Between(known) => Ok((known, Duration::ZERO)),
            At::After(_) | At::Empty => {
                Err(Gap::Waits { joint, waited: Duration::from_micros(now.0.saturating_sub(at.0)) })
            }
            At::Before => Err(Gap::Gone { joint }),
        })
    }

    /// The posture at a time by what is known now: joints go on with their last velocity, within their
    /// limits. After 0.2 s they stand still, and the bound of the error grows on.
    pub fn live(&self, at: Micros) -> Result<Estimate, Gap> {
        self.estimate(|joint, track| match track.at(at.0) {
            At::Between(known) => Ok((known, Duration::ZERO)),
            At::After(last) => {
                let known = track.after(at.0).ok_or(Gap::Unmoved { joint })?;
                Ok((known, Duration::from_micros(at.0.saturating_sub(last))))
            }
            At::Empty => Err(Gap::Unmoved { joint }),
            At::Before => Err(Gap::Gone { joint }),
        })
    }

    fn estimate(
        &self,
        of: impl Fn(usize, &JointTrack) -> Result<(Bounded, Duration), Gap>,
    ) -> Result<Estimate, Gap> {
        let count = self.tracks.len();
        let mut estimate =
            Estimate { posture: self.robot.rest(), errors: vec![f64::INFINITY; count], age: Duration::ZERO };
        for (number, track) in self.tracks.iter().enumerate().filter(|(number, _)| self.is_needed[*number]) {
            let (known, age) = of(self.robot.free()[number], track)?;
            (estimate.posture[number], estimate.errors[number]) = (known.position, known.error);
            estimate.age = estimate.age.max(age);
        }
        Ok(estimate)
    }
}
