//! Behaviours' files: read, and checked against a robot.

use super::apart::{self, ApartLinks};
use super::config::{BehaviourConfig, TouchAction};
use super::limits::JointLimit;
use crate::body::robot::Robot;
use crate::error::{Context, Result, SettingError, UsageError};
use crate::files::input;
use crate::text::{toml_key, words};
use std::fmt::Display;
use std::path::Path;

/// The shipped behaviours.
const SHIPPED: [(&str, &str); 1] = [("people", include_str!("../../behaviours/people.toml"))];
/// Least time of touch before it leads, s.
const LEADS_AFTER_S: f64 = 0.3;

/// A behaviour, checked against a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Behaviour {
    /// The text that its author has written.
    pub config: BehaviourConfig,
    /// Limits of the joints, in the order of [`Robot::free`].
    pub joints: Vec<JointLimit>,
    /// Links that are kept apart.
    pub(super) apart: Vec<ApartLinks>,
}

impl Behaviour {
    /// Reads a behaviour for a robot: a TOML file, or a shipped one by name (`people`). Errors name file, line and key.
    pub fn read(name_or_path: &str, robot: &Robot) -> Result<Behaviour> {
        if let Some((name, text)) = SHIPPED.iter().find(|(name, _)| *name == name_or_path) {
            return Behaviour::parse(name, text, robot);
        }
        // A text that cannot be a path is a name.
        if !name_or_path.contains(['.', '/', '\\']) && !Path::new(name_or_path).exists() {
            let known = words::unknown("behaviour", name_or_path, SHIPPED.map(|(name, _)| name));
            fail!(UsageError::Unknown, "{known}, or give a .toml file");
        }
        let text = input::text(name_or_path).with_context(|| format!("{name_or_path} cannot be read"))?;
        Behaviour::parse(name_or_path, &text, robot)
    }

    /// Reads the text of a behaviour for a robot. `file` names it in errors.
    pub fn parse(file: &str, text: &str, robot: &Robot) -> Result<Behaviour> {
        let config: BehaviourConfig =
            toml::from_str(text).map_err(|error| SettingError::Malformed(words::toml(&error, text, file)))?;
        let place = BehaviourText { file, text };
        place.check(&config)?;
        let joints = place.joints(&config, robot)?;
        let pairs = config.apart.iter().enumerate().map(|(row, pair)| {
            apart::links(robot, pair).map_err(|why| place.wrong(&format!("apart[{row}].links"), why))
        });
        let apart = pairs.collect::<Result<Vec<_>, _>>()?;
        Ok(Behaviour { joints, apart, config })
    }
}

/// The file and its text, for errors.
struct BehaviourText<'a> {
    file: &'a str,
    text: &'a str,
}

impl BehaviourText<'_> {
    fn wrong(&self, key: &str, why: impl Display) -> SettingError {
        toml_key::error(self.file, self.text, key, why)
    }

    /// Error unless a number is within a range.
    fn within(&self, key: &str, number: f64, least: f64, most: f64) -> Result<(), SettingError> {
        if (least..=most).contains(&number) {
            return Ok(());
        }
        Err(self.wrong(key, format_args!("must be {least} to {most}, not {number}")))
    }

    /// Checks what does not depend on the robot.
    fn check(&self, config: &BehaviourConfig) -> Result<(), SettingError> {
        let BehaviourConfig { retreat, yields, clamp, resume, faults, .. } = config;
        for (key, number, least, most) in [
            ("retreat.speed", retreat.speed, 0.01, 2.0),
            ("retreat.seconds", retreat.seconds, 0.0, 5.0),
            ("retreat.begin", retreat.begin, 0.05, 1.0),
            ("yield.mass", yields.mass, 0.1, 100.0),
            ("yield.damping", yields.damping, 1.0, 1000.0),
            ("yield.after_s", yields.after_s, LEADS_AFTER_S, 60.0),
            ("yield.speed", yields.speed, 0.01, 2.0),
            ("yield.rest_s", yields.rest_s, 0.005, 0.2),
            ("clamp.newtons", clamp.newtons, 0.1, 100.0),
            ("clamp.cosine", clamp.cosine, -1.0, 0.0),
            ("clamp.seconds", clamp.seconds, 0.0, 60.0),
            ("resume.after_s", resume.after_s, 0.0, 600.0),
            ("resume.over_s", resume.over_s, 0.0, 60.0),
            ("tank_j", config.tank_j, 0.0, 100.0),
            ("faults.posture_ms", faults.posture_ms, 1.0, 1000.0),
            ("faults.frame_ms", faults.frame_ms, 1.0, 1000.0),
            ("faults.cycle_ms", faults.cycle_ms, 1.0, 1000.0),
        ] {
            self.within(key, number, least, most)?;
        }
        for (row, pair) in config.apart.iter().enumerate() {
            self.within(&format!("apart[{row}].metres"), pair.metres, 0.0, 10.0)?;
        }
        for (row, limit) in config.limits.iter().enumerate() {
            self.within(&format!("limits[{row}].newtons"), limit.newtons, 0.1, 1000.0)?;
            if limit.source.trim().is_empty() {
                return Err(self.wrong(&format!("limits[{row}].source"), "says where the limit comes from"));
            }
        }
        for (row, when) in config.when.iter().enumerate() {
            self.within(&format!("when[{row}].newtons"), when.newtons, 0.0, 1000.0)?;
            let key = format!("when[{row}].factor");
            match (when.action, when.factor) {
                (TouchAction::Slow, Some(factor)) => self.within(&key, factor, 0.0, 1.0)?,
                (TouchAction::Slow, None) => return Err(self.wrong(&key, "`slow` needs a factor, 0 to 1")),
                (_, Some(_)) => return Err(self.wrong(&key, "only `slow` has a factor")),
                (_, None) => {}
            }
        }
        Ok(())
    }

    /// The limits of a robot's joints.
    fn joints(&self, config: &BehaviourConfig, robot: &Robot) -> Result<Vec<JointLimit>, SettingError> {
        let of_all = config.joints;
        for (key, number, least, most) in [
            ("joints.velocity", of_all.velocity, 0.0, 20.0),
            ("joints.acceleration", of_all.acceleration, 0.1, 1000.0),
            ("joints.margin", of_all.margin, 0.0, 1.0),
        ] {
            self.within(key, number, least, most)?;
        }
        let free = || robot.free().iter().filter_map(|joint| robot.joints().get(*joint));
        for (name, joint) in &config.joint {
            let key = format!("joint.{name}");
            if !free().any(|known| known.name == *name) {
                let known = free().map(|known| known.name.as_str());
                return Err(self.wrong(&key, words::unknown("joint", name, known)));
            }
            for (part, number, least, most) in [
                ("velocity", joint.velocity, 0.0, 20.0),
                ("acceleration", joint.acceleration, 0.1, 1000.0),
                ("margin", joint.margin, 0.0, 1.0),
            ] {
                self.within(&format!("{key}.{part}"), number.unwrap_or(least), least, most)?;
            }
        }
        let limit = |(free, joint): (usize, &crate::body::robot::RobotJoint)| {
            let own = config.joint.get(&joint.name).copied().unwrap_or_default();
            let velocity = own.velocity.unwrap_or(of_all.velocity);
            JointLimit {
                velocity: match own.moves {
                    Some(false) => 0.0,
                    _ => velocity.min(joint.velocity.unwrap_or(velocity)).max(0.0),
                },
                acceleration: own.acceleration.unwrap_or(of_all.acceleration),
                positions: robot.range(free, own.margin.unwrap_or(of_all.margin)),
            }
        };
        Ok(free().enumerate().map(limit).collect())
    }
}
