//! Inputs that others send the robot: values on their way to its mind, and its joints.

use super::inbox::received;
use super::node::RosNode;
use super::posture::at;
use super::raw::JointState;
use anyhow::Result;
use ros2_client::Subscription;
use ros2_client::log::LogLevel;
use std::time::{Duration, Instant};
use taxel::fcm::robot_source::RobotSource;
use taxel::mind::{HostInputLine, RobotMeaning, RobotMind};
use taxel::robot::{ReadRobot, RobotStream};
use taxel::ros2::topic_part;
use taxel::ros2::topics::{HOST_INPUT, JOINT_STATES};
use taxel::session::JointTime;
use taxel::text::words;

/// Shortest time between two looks: the mind does not think more often.
const PAUSE: Duration = Duration::from_millis(5);
/// Shortest time between two complaints.
const COMPLAINT: Duration = Duration::from_secs(5);

/// Subscriptions to what the robot's map hears by a name, and to the robot's joints.
pub struct HostInputTopics {
    values: Vec<(String, Subscription<f64>)>,
    /// None without a description of the robot.
    joints: Option<Subscription<JointState>>,
    looked: Instant,
    complained: Option<Instant>,
}

impl HostInputTopics {
    /// Subscribes to what the mind hears, and to no others.
    pub fn open(node: &mut RosNode, robot: &ReadRobot, mind: &RobotMind) -> Result<HostInputTopics> {
        let mut values: Vec<(String, Subscription<f64>)> = Vec::new();
        for input in mind.inputs() {
            let RobotSource::HostInput(name) = &input.source else { continue };
            if !values.iter().any(|(known, _)| known == name) {
                values.push((name.clone(), node.subscribe(&HOST_INPUT, &topic_part(name))?));
            }
        }
        let joints = robot.robot.as_ref().map(|_| node.subscribe(&JOINT_STATES, "")).transpose()?;
        Ok(HostInputTopics { values, joints, looked: Instant::now(), complained: None })
    }

    /// Sends the mind what has come until now, and the boards the robot's posture. Returns what touches mean
    /// then, if that is news.
    pub fn turn<T: Send + 'static>(
        &mut self,
        node: &RosNode,
        robot: &ReadRobot,
        mind: &mut RobotMind,
        session: &RobotStream<T>,
    ) -> Option<RobotMeaning> {
        if self.looked.elapsed() < PAUSE {
            return None;
        }
        self.looked = Instant::now();
        let now_us = session.now_us();
        let (mut news, mut wrong) = (None, None);
        let mut take = |line: &HostInputLine, host_us: u64, topic: &str| match mind.take_input(line, host_us)
        {
            Ok(meaning) => {
                news = meaning.cloned().or(news.take());
                session.take_joints(host_us, line.joints());
            }
            Err(error) => wrong = Some(format!("{topic}: {}", words::sentence(&error))),
        };
        for (name, values) in &self.values {
            if let Some(value) = received(values).last() {
                let line =
                    HostInputLine { host_input: [(name.clone(), value)].into(), ..HostInputLine::default() };
                take(&line, now_us, HOST_INPUT.name);
            }
        }
        for state in self.joints.iter().flat_map(received) {
            let host_us = match at(state.header.stamp, JointTime::Host) {
                JointTime::Host(us) => us.min(now_us),
                _ => now_us,
            };
            take(&positions(robot, &state), host_us, JOINT_STATES.name);
        }
        if let Some(wrong) =
            wrong.filter(|_| self.complained.is_none_or(|reported| reported.elapsed() > COMPLAINT))
        {
            self.complained = Some(Instant::now());
            node.log(LogLevel::Warn, &wrong);
        }
        news
    }
}

/// The positions of the robot's own joints: others may be sent, too.
fn positions(robot: &ReadRobot, state: &JointState) -> HostInputLine {
    let is_own = |joint: &String| robot.robot.as_ref().is_some_and(|robot| robot.joint(joint).is_ok());
    let own = state.name.iter().zip(&state.position).filter(|(joint, _)| is_own(joint));
    HostInputLine {
        positions: own.map(|(joint, at)| (joint.clone(), *at)).collect(),
        ..HostInputLine::default()
    }
}
