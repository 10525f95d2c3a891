//! A command as JSON.

use super::command::{MotionCause, MotionCommand};
use super::guard::MotionFault;
use crate::body::robot::Robot;
use serde_json::{Map, Value, json};

/// Type of the message.
pub const MOTION: &str = "motion";

impl MotionCommand {
    /// The command at a time of the host, us: an object of the type [`MOTION`]. Velocities are by the names of the
    /// joints, rad/s or m/s, and each cause has the touch, its place, its force and what is done about it.
    pub fn line(&self, robot: &Robot, host_us: u64) -> Value {
        let joints = robot.free().iter().filter_map(|joint| robot.joints().get(*joint));
        let named = joints.zip(&self.velocities).map(|(joint, at)| (joint.name.clone(), (*at).into()));
        let cause = |cause: &MotionCause| {
            json!({
                "touch": cause.touch, "region": cause.place.region, "link": cause.place.link,
                "newtons": cause.newtons, "do": cause.action.as_str(), "row": cause.row,
            })
        };
        json!({
            "type": MOTION,
            "host_time_us": host_us,
            "phase": self.phase.as_str(),
            "deed": self.deed.as_str(),
            "fault": self.fault.map(MotionFault::as_str),
            "speed": self.speed,
            "velocities": named.collect::<Map<String, Value>>(),
            "tank_j": self.tank_j,
            "share": self.share,
            "causes": self.causes.iter().map(cause).collect::<Vec<_>>(),
        })
    }

    /// Summary in words: `retreat; left_forearm 41.0 N`.
    pub fn text(&self) -> String {
        let why = self.fault.map(|fault| fault.as_str().replace('_', " "));
        let causes = self.causes.iter().map(|cause| format!("{} {:.1} N", cause.place.link, cause.newtons));
        let speed = self.speed.map(|speed| format!("speed {speed:.2}"));
        let words = [self.deed.as_str().to_string()].into_iter().chain(why).chain(speed).chain(causes);
        words.collect::<Vec<_>>().join(", ")
    }
}
