//! Speed of the robot's own links, by the positions of its joints.

use crate::body::DVec3;
use crate::body::posture::{JointHistory, Motion};
use crate::body::robot::{Poses, Robot};
use crate::error::Result;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;
use taxel_core::format::Micros;

/// Time over which a speed is taken, us.
const STEP_US: u64 = 10_000;
/// Age of the joints from which nothing is known of the robot's motion.
const SILENT: Duration = Duration::from_millis(300);
/// Distance from a link's origin at which its turning counts, m: half of a forearm.
const REACH_M: f64 = 0.1;

/// The joints of a robot as they are sent, and the speeds of its links.
#[derive(Debug, Clone)]
pub struct LinkSpeeds {
    robot: Arc<Robot>,
    history: JointHistory,
    reported: BTreeSet<usize>,
    /// Number of times that positions were taken.
    taken: u64,
}

/// Places of the links of a robot at a time.
#[derive(Debug, Clone)]
pub struct LinksAt<'a> {
    robot: &'a Robot,
    poses: Poses,
}

impl LinksAt<'_> {
    /// A point of a link and a direction there in the base; none without such a link.
    pub fn point(&self, link: &str, at: DVec3, direction: DVec3) -> Option<(DVec3, DVec3)> {
        let pose = self.poses.of(self.robot.link(link).ok()?, 0)?;
        Some((pose.point(at), pose.direction(direction)))
    }
}

impl LinkSpeeds {
    /// Nothing is sent yet.
    pub fn new(robot: Arc<Robot>) -> Result<LinkSpeeds> {
        let mut history = JointHistory::new(robot.clone(), Motion::default())?;
        history.need(&[]);
        Ok(LinkSpeeds { robot, history, reported: BTreeSet::new(), taken: 0 })
    }

    /// Takes positions of joints, rad or m, at a time of the host, us. Joints that were never sent rest.
    /// Error, and nothing is taken, if the robot has no such joint or a position is out of its range.
    pub fn take<'a>(
        &mut self,
        host_us: u64,
        positions: impl IntoIterator<Item = (&'a str, f64)> + Clone,
    ) -> Result<()> {
        self.history.take(Micros(host_us), positions.clone())?;
        self.taken += 1;
        for (name, _) in positions {
            let joint = self.robot.joint(name)?;
            self.reported.extend(self.robot.free().iter().position(|free| *free == joint));
        }
        self.history.need(&Vec::from_iter(self.reported.iter().copied()));
        Ok(())
    }

    /// Number of times that positions were taken: while it is the same, so is all that is known of a time.
    pub fn taken(&self) -> u64 {
        self.taken
    }

    /// Returns where the links are at a time of the host, us; none if nothing is known of the joints at that time.
    pub fn at(&self, host_us: u64) -> Option<LinksAt<'_>> {
        if self.reported.is_empty() {
            return None;
        }
        let estimate = self.history.live(Micros(host_us)).ok()?;
        if estimate.age > SILENT {
            return None;
        }
        Some(LinksAt { robot: &self.robot, poses: self.robot.poses(&estimate.posture) })
    }

    /// Speed of the fastest of the links that are meant, mm/s, and the age of the joints, ms. The speed of a
    /// link is that of its origin, and of its turning at 0.1 m from there. None before two readings of each
    /// joint that was sent.
    pub fn fastest(&self, host_us: u64, is_meant: impl Fn(&str) -> bool) -> Option<(i32, u32)> {
        if self.reported.is_empty() {
            return None;
        }
        let now = self.history.live(Micros(host_us)).ok()?;
        let before = self.history.live(Micros(host_us.saturating_sub(STEP_US))).ok()?;
        let [here, there] = [&now, &before].map(|estimate| self.robot.poses(&estimate.posture));
        let seconds = STEP_US as f64 * 1e-6;
        let meant = self.robot.links().iter().enumerate().filter(|(_, link)| is_meant(&link.name));
        let speeds = meant.filter_map(|(link, _)| {
            let (now, before) = (here.of(link, 0)?, there.of(link, 0)?);
            let turned = now.turn.angle_between(before.turn);
            Some((now.at.distance(before.at) + turned * REACH_M) / seconds)
        });
        let fastest = speeds.fold(0.0, f64::max);
        Some(((fastest * 1e3).round() as i32, u32::try_from(now.age.as_millis()).unwrap_or(u32::MAX)))
    }
}
