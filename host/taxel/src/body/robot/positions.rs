//! Positions of a robot's joints by their names.

use super::model::{JointKind, Robot, RobotJoint};
use crate::error::{Result, RobotError, UsageError};
use crate::text::words;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Share of a joint's range by which a measured position may be beyond its limits: encoders are set to zero by
/// hand, and stops yield.
const SLACK: f64 = 0.02;

impl Robot {
    /// Number of a link; 0 is the base.
    pub fn link(&self, name: &str) -> Result<usize, RobotError> {
        self.links.iter().position(|link| link.name == name).ok_or_else(|| {
            let known = self.links.iter().map(|link| link.name.as_str());
            let text = format!("{}: {}", self.file, words::unknown("link", name, known));
            RobotError::NoLink { link: name.into(), text }
        })
    }

    /// Number of a joint.
    pub fn joint(&self, name: &str) -> Result<usize, RobotError> {
        self.joints.iter().position(|joint| joint.name == name).ok_or_else(|| {
            let known = self.free.iter().map(|joint| self.joints[*joint].name.as_str());
            let text = format!("{}: {}", self.file, words::unknown("joint", name, known));
            RobotError::NoJoint { joint: name.into(), text }
        })
    }

    /// The posture at rest: each joint at 0, or in the middle of its range if 0 is outside.
    pub fn rest(&self) -> Vec<f64> {
        let rest = |joint: &usize| match &self.joints[*joint].limits {
            Some(limits) if !limits.contains(&0.0) => limits.start().midpoint(*limits.end()),
            _ => 0.0,
        };
        self.free.iter().map(rest).collect()
    }

    /// The posture with these joints at these positions, rad or m, and the others at rest. Errors name a joint
    /// that the robot does not have, that has no position of its own, or that is out of its range.
    pub fn posture<'a>(
        &self,
        positions: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Vec<f64>, RobotError> {
        let mut posture = self.rest();
        for (name, position) in positions {
            let joint = self.joint(name)?;
            let Some(free) = self.free.iter().position(|free| *free == joint) else {
                return Err(self.not_free(joint));
            };
            posture[free] = position;
        }
        self.check(&posture)?;
        Ok(posture)
    }

    /// [`Robot::posture`] of a text: `elbow=30deg,wrist=-0.5rad,lift=0.1m`.
    pub fn posture_of(&self, text: &str) -> Result<Vec<f64>> {
        let parts = text.split(',').map(str::trim).filter(|part| !part.is_empty());
        let positions = parts.map(|part| {
            let wrong =
                || error!(UsageError::Argument, "{part}: write JOINT=30deg, JOINT=0.5rad or JOINT=0.1m");
            let (name, position) = part.split_once('=').ok_or_else(wrong)?;
            let (name, position) = (name.trim(), position.trim());
            let joint = &self.joints[self.joint(name)?];
            let units: &[(&str, f64)] = match joint.kind {
                JointKind::Prismatic => &[("m", 1.0)],
                _ => &[("deg", 1f64.to_radians()), ("rad", 1.0)],
            };
            let read = |(unit, factor): &(&str, f64)| {
                Some(position.strip_suffix(unit)?.trim().parse::<f64>().ok()? * factor)
            };
            Ok((name, units.iter().find_map(read).ok_or_else(wrong)?))
        });
        Ok(self.posture(positions.collect::<Result<Vec<_>>>()?)?)
    }

    /// Checks that a posture is within the limits, those of joints that mimic others, too.
    pub fn check(&self, posture: &[f64]) -> Result<(), RobotError> {
        for joint in &self.joints {
            let Some(drive) = joint.drive else { continue };
            self.within(joint, drive.position(posture), 0.0)?;
        }
        Ok(())
    }

    /// Positions of a joint of [`Robot::free`] that are at least `margin`, rad or m, within its limits, and within those
    /// of the joints that mimic it; the middle of its range if it is not wide enough. None if nothing limits it.
    pub fn range(&self, free: usize, margin: f64) -> Option<RangeInclusive<f64>> {
        let limited = self.joints.iter().filter_map(|joint| Some((joint.drive?, joint.limits.as_ref()?)));
        let own = limited.filter(|(drive, _)| drive.free == free && drive.multiplier != 0.0);
        let ranges = own.map(|(drive, limits)| {
            let at = |position: f64| (position - drive.offset) / drive.multiplier;
            let (a, b) = (at(*limits.start()), at(*limits.end()));
            (a.min(b), a.max(b))
        });
        let (least, most) = ranges.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)))?;
        let middle = least.midpoint(most);
        Some((least + margin).min(middle)..=(most - margin).max(middle))
    }

    /// Checks a measured position of [`Robot::free`], which may be beyond the limits by a fiftieth of the range.
    pub(in crate::body) fn check_measured(&self, free: usize, position: f64) -> Result<(), RobotError> {
        match self.free.get(free).and_then(|joint| self.joints.get(*joint)) {
            Some(joint) => self.within(joint, position, SLACK),
            None => Ok(()),
        }
    }

    fn within(&self, joint: &RobotJoint, position: f64, slack: f64) -> Result<(), RobotError> {
        let wrong = |what: &dyn Display| RobotError::Position {
            joint: joint.name.clone(),
            text: format!("{}, line {}, joint \"{}\": {what}", self.file, joint.line, joint.name),
        };
        if !position.is_finite() {
            return Err(wrong(&format!("its position must be a number, not {position}")));
        }
        let Some(limits) = &joint.limits else { return Ok(()) };
        let beyond = slack * (limits.end() - limits.start());
        if (limits.start() - beyond..=limits.end() + beyond).contains(&position) {
            return Ok(());
        }
        let said = |position: f64| match joint.kind {
            JointKind::Prismatic => format!("{} m", rounded(position)),
            _ => format!("{}\u{b0}", rounded(position.to_degrees())),
        };
        let [least, most, position] = [*limits.start(), *limits.end(), position].map(said);
        Err(wrong(&format!("{position} is out of its range, {least} to {most}")))
    }

    /// Error about a joint whose position follows from others, or that has none.
    fn not_free(&self, joint: usize) -> RobotError {
        let RobotJoint { name, line, drive, .. } = &self.joints[joint];
        let what = match drive {
            Some(drive) => {
                let leader = &self.joints[self.free[drive.free]].name;
                format!("mimics the joint \"{leader}\": move that one")
            }
            None => "is fixed".into(),
        };
        let text = format!("{}, line {line}, joint \"{name}\": {what}", self.file);
        RobotError::NoJoint { joint: name.clone(), text }
    }
}

/// To four decimals, and 0 without a sign.
fn rounded(number: f64) -> f64 {
    (number * 1e4).round() / 1e4 + 0.0
}
