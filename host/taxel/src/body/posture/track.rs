//! The positions of one joint over time.

use super::motion::Motion;
use crate::body::robot::{JointKind, RobotJoint};
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

/// Time after the last reading from which a joint is taken to stand still, s: it has a target, and whoever
/// sends its position may be gone. The bound of the error grows on.
const HORIZON_S: f64 = 0.2;

/// A position at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct JointReading {
    at_us: u64,
    /// rad or m
    position: f64,
}

/// A position, and the most by which it is off, rad or m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounded {
    pub position: f64,
    pub error: f64,
}

/// Place of a time among the readings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum At {
    /// At or between readings.
    Between(Bounded),
    /// After all of them, and the time of the last.
    After(u64),
    /// Before all that are kept.
    Before,
    /// There are none.
    Empty,
}

/// Readings of a joint, in the order of their times.
#[derive(Debug, Clone)]
pub(super) struct JointTrack {
    readings: VecDeque<JointReading>,
    kept: usize,
    is_continuous: bool,
    limits: Option<RangeInclusive<f64>>,
    velocity: Option<f64>,
    /// Greatest acceleration, rad/s^2 or m/s^2.
    acceleration: f64,
    /// Greatest error of a reading, rad or m.
    error: f64,
}

impl JointTrack {
    pub fn new(joint: &RobotJoint, motion: &Motion, kept: usize) -> JointTrack {
        let (acceleration, error) = match joint.kind {
            JointKind::Prismatic => (motion.linear, motion.linear_error),
            _ => (motion.angular, motion.angular_error),
        };
        let is_continuous = joint.kind == JointKind::Continuous;
        JointTrack {
            readings: VecDeque::new(),
            kept: kept.max(2),
            is_continuous,
            limits: joint.limits.clone(),
            velocity: joint.velocity.or(is_continuous.then_some(motion.angular_velocity)),
            acceleration,
            error,
        }
    }

    /// Adds a reading, late ones as well; a second one of a time replaces the first. The oldest gives way.
    pub fn take(&mut self, at_us: u64, position: f64) {
        let place = self.readings.partition_point(|reading| reading.at_us < at_us);
        let reading = JointReading { at_us, position };
        match self.readings.get_mut(place).filter(|held| held.at_us == at_us) {
            Some(held) => *held = reading,
            None => self.readings.insert(place, reading),
        }
        if self.readings.len() > self.kept {
            self.readings.pop_front();
        }
    }

    pub fn clear(&mut self) {
        self.readings.clear();
    }

    /// Way from a reading to the next. Of a joint that turns on and on it is the shorter one; none if it may
    /// have turned by half a turn.
    fn step(&self, from: JointReading, to: JointReading) -> Option<f64> {
        let step = to.position - from.position;
        if !self.is_continuous {
            return Some(step);
        }
        let most = self.turned(seconds(from.at_us, to.at_us)) + self.error;
        (most < PI).then_some(step - TAU * (step / TAU).round())
    }

    /// The most by which a joint that turns on and on differs from a reading after or before a time, s.
    fn turned(&self, seconds: f64) -> f64 {
        self.velocity.unwrap_or(f64::INFINITY) * seconds + self.error
    }

    /// A position near a reading where it is not known which way the joint has turned since: it is off by
    /// half a turn at most.
    fn near(&self, reading: JointReading, passed: f64) -> Bounded {
        Bounded { position: reading.position, error: self.turned(passed).min(PI) }
    }

    /// The position at a time that has readings on both sides.
    ///
    /// The line through two readings is off from a motion with the acceleration `a` by at most
    /// `a / 2 * (t - t0) * (t1 - t)`.
    pub fn at(&self, at_us: u64) -> At {
        let next = self.readings.partition_point(|reading| reading.at_us < at_us);
        let before = next.checked_sub(1).and_then(|before| self.readings.get(before));
        match (before, self.readings.get(next)) {
            (_, Some(exact)) if exact.at_us == at_us => {
                At::Between(Bounded { position: exact.position, error: self.error })
            }
            (Some(before), Some(after)) => {
                let [passed, left] = [seconds(before.at_us, at_us), seconds(at_us, after.at_us)];
                let Some(step) = self.step(*before, *after) else {
                    let (nearer, time) = if passed < left { (before, passed) } else { (after, left) };
                    return At::Between(self.near(*nearer, time));
                };
                let position = before.position + step * (passed / (passed + left));
                At::Between(Bounded { position, error: self.acceleration / 2.0 * passed * left + self.error })
            }
            (Some(last), None) => At::After(last.at_us),
            (None, Some(_)) => At::Before,
            (None, None) => At::Empty,
        }
    }

    /// The position at a time after the last reading, by the velocity that it had; none with fewer than two.
    ///
    /// The line through two readings, `h` apart, is off from a motion with the acceleration `a` by at most
    /// `a / 2 * t * (h + t)` a time `t` after the second, and an error `e` of each reading grows to
    /// `e * (1 + 2 t / h)`. Of the earlier readings, the one with the least sum is taken.
    pub fn after(&self, at_us: u64) -> Option<Bounded> {
        let last = *self.readings.back().filter(|_| self.readings.len() > 1)?;
        let passed = seconds(last.at_us, at_us);
        let (mut way, mut newer) = (0.0, last);
        let mut best: Option<(f64, f64)> = None;
        for earlier in self.readings.iter().rev().skip(1) {
            let Some(step) = self.step(*earlier, newer) else { break };
            way += step;
            newer = *earlier;
            let apart = seconds(earlier.at_us, last.at_us);
            let bend = self.acceleration / 2.0 * passed * (apart + passed);
            if best.is_some_and(|(error, _)| error <= bend) {
                break;
            }
            let error = bend + self.error * (1.0 + 2.0 * passed / apart);
            if best.is_none_or(|(least, _)| error < least) {
                best = Some((error, way / apart));
            }
        }
        let Some((error, velocity)) = best else { return Some(self.near(last, passed)) };
        let straight = last.position + velocity * passed;
        let limited = self.velocity.map_or(velocity, |most| velocity.clamp(-most, most));
        let mut position = last.position + limited * passed.min(HORIZON_S);
        if let Some(limits) = &self.limits {
            // A reading may be beyond the limits.
            position = position.clamp(limits.start().min(last.position), limits.end().max(last.position));
        }
        // The bound is that of the straight line, wherever the limits have led.
        Some(Bounded { position, error: error + (position - straight).abs() })
    }
}

/// Time between two stamps in this order, s.
fn seconds(from_us: u64, to_us: u64) -> f64 {
    to_us.saturating_sub(from_us) as f64 * 1e-6
}
