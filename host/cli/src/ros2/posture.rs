//! Joint states on their way to the board, as its posture.

use super::inbox::received;
use super::node::RosNode;
use super::raw::JointState;
use anyhow::Result;
use ros2_client::Subscription;
use ros2_client::log::LogLevel;
use std::time::{Duration, Instant};
use taxel::client::Client;
use taxel::ros2::messages;
use taxel::ros2::topics::{JOINT_STATES, POSTURE};
use taxel::session::{JointTime, Posing};
use taxel::text::words;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::{Name, name};
use taxel_core::wire::Request;

/// Longest wait for the board's answer before the next posture is sent.
const ANSWER: Duration = Duration::from_millis(500);
/// Shortest time between two complaints about joint states.
const COMPLAINT: Duration = Duration::from_secs(5);
/// Shortest time between two postures: joint states may come every millisecond.
const PAUSE: Duration = Duration::from_millis(10);

/// The newest joint states, and those that the board has not answered yet. One posture is under way at a
/// time.
pub struct Postures {
    states: Subscription<JointState>,
    newest: Option<JointState>,
    asked: Option<JointState>,
    sent: Instant,
    /// Time at which joint states were last complained of.
    reported: Option<Instant>,
    /// A robot's posture takes what comes.
    is_posing: bool,
}

impl Postures {
    /// Subscribes to the joint states.
    pub fn open(node: &mut RosNode) -> Result<Postures> {
        node.offer(&POSTURE, "")?;
        Ok(Postures {
            states: node.subscribe(&JOINT_STATES, "")?,
            newest: None,
            asked: None,
            sent: Instant::now(),
            reported: None,
            is_posing: false,
        })
    }

    /// Takes what has come.
    fn read(&mut self, mut each: impl FnMut(&JointState)) {
        for state in received(&self.states) {
            each(&state);
            self.newest = Some(state);
        }
    }

    /// Hands over the positions of a robot's joints that have come, at the times that their stamps are by
    /// `time`. What is wrong with them is another program's mistake: it is reported every five seconds.
    pub fn pose(
        &mut self,
        node: &RosNode,
        client: &Client,
        posing: &mut Posing,
        time: impl Fn(u64) -> JointTime,
    ) {
        self.is_posing = true;
        let mut wrong = None;
        self.read(|state| {
            let named = state.name.iter().zip(&state.position);
            // Others than this robot's may be sent, too.
            let own: Vec<(String, f64)> = named
                .filter(|(joint, _)| posing.robot().joint(joint).is_ok())
                .map(|(joint, position)| (joint.clone(), *position))
                .collect();
            let positions = own.iter().map(|(joint, position)| (joint.as_str(), *position));
            if let Err(error) = posing.take(client, at(state.header.stamp, &time), positions) {
                wrong = Some(words::sentence(&error));
            }
        });
        if let Some(wrong) =
            wrong.filter(|_| self.reported.is_none_or(|reported| reported.elapsed() > COMPLAINT))
        {
            self.reported = Some(Instant::now());
            node.log(LogLevel::Warn, &format!("joint_states: {wrong}"));
        }
    }

    /// Takes what has come, and sends the newest.
    pub fn turn(&mut self, client: &mut Client) -> Result<()> {
        if !self.is_posing {
            self.read(|_| ());
        }
        let waits = if self.asked.is_some() { ANSWER } else { PAUSE };
        let joints = client.description().map_or(&[][..], |description| description.scene.joints.as_slice());
        if self.sent.elapsed() < waits || joints.is_empty() {
            return Ok(());
        }
        let Some(state) = self.newest.take() else { return Ok(()) };
        let posture = posture(joints, &state);
        if !posture.joints.is_empty() {
            client.request(&Request::Posture(posture))?;
            (self.asked, self.sent) = (Some(state), Instant::now());
        }
        Ok(())
    }

    /// Reports the posture that the board has accepted.
    pub fn answered(&mut self, node: &mut RosNode, client: &Client, is_done: bool) -> Result<()> {
        let Some(state) = self.asked.take().filter(|_| is_done) else { return Ok(()) };
        let joints = client.description().map_or(&[][..], |description| description.scene.joints.as_slice());
        let posture = posture(joints, &state);
        let reported = posture.joints.iter().filter_map(|angle| {
            Some((
                joints.get(usize::from(angle.joint))?.as_str(),
                f64::from(angle.centidegrees).to_radians() / 100.0,
            ))
        });
        let (names, positions): (Vec<&str>, Vec<f64>) = reported.unzip();
        node.publish(&POSTURE, "", messages::joints(state.header.stamp, &names, &positions))
    }
}

/// Returns when joint states with this stamp, seconds and nanoseconds, were read: now, if there is none, else by
/// `time`.
pub fn at((sec, nanosec): (i32, u32), time: impl Fn(u64) -> JointTime) -> JointTime {
    let us = u64::try_from(sec).unwrap_or(0) * 1_000_000 + u64::from(nanosec / 1000);
    if us == 0 { JointTime::Now } else { time(us) }
}

/// Angles of the scene's joints. A scene's names have at most 16 bytes: as much of the joint's name counts.
fn posture(joints: &[Name], state: &JointState) -> Posture {
    let angle = |(joint, position): (&String, &f64)| {
        let index = joints.iter().position(|known| *known == name(joint))?;
        // A joint that turns on and on has the angle that it shows.
        let degrees = (position.to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
        let is_angle = position.is_finite();
        is_angle.then(|| JointAngle { joint: index as u8, centidegrees: (degrees * 100.0).round() as i16 })
    };
    // A scene has no more joints than a posture.
    Posture { joints: state.name.iter().zip(&state.position).filter_map(angle).take(joints.len()).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joint_states_without_a_stamp_are_of_now() {
        assert_eq!(at((3, 4_999), JointTime::Host), JointTime::Host(3_000_004));
        assert_eq!([at((0, 999), JointTime::Host), at((-5, 0), JointTime::Host)], [JointTime::Now; 2]);
    }

    #[test]
    fn joints_are_found_by_name_and_turned_to_degrees() {
        let joints = [name("elbow"), name("left_shoulder_pitch_joint")];
        let state = JointState {
            name: ["left_shoulder_pitch_joint", "knee", "elbow", "elbow"].map(String::from).to_vec(),
            position: vec![std::f64::consts::FRAC_PI_2, 1.0, 3.0 * std::f64::consts::PI, f64::NAN],
            ..JointState::default()
        };
        let angles: Vec<_> =
            posture(&joints, &state).joints.iter().map(|j| (j.joint, j.centidegrees)).collect();
        assert_eq!(angles, [(1, 9000), (0, -18_000)]);
    }
}
