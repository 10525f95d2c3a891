//! The node of `taxel motion`: joint states and calls in, commands out.

use super::inbox::{calls, received};
use super::node::RosNode;
use super::posture::at;
use super::raw::{Done, JointState, Triggered};
use anyhow::Result;
use ros2_client::log::LogLevel;
use ros2_client::{RmwRequestId, Server, Subscription};
use taxel::motion::{MotionCommand, MotionControl, MotionFault, MotionFeed, MotionPhase};
use taxel::ros2::topics::{
    ARM, DISARM, JOINT_JOG, JOINT_STATES, MOTION, MOTION_PUBLISHED, SPEED_SCALING, TOUCH_WRENCH, TWIST,
    VELOCITIES,
};
use taxel::ros2::{messages, motion};
use taxel::session::JointTime;

/// Time for which a jog holds, s: MoveIt Servo drops older ones.
const HOLDS_S: f64 = 0.1;

/// Publishes what a robot is commanded.
pub struct MotionNode {
    node: RosNode,
    joints: Subscription<JointState>,
    arm: Server<Triggered, Done>,
    disarm: Server<Triggered, Done>,
    /// Calls that wait for their answers, in their order; true: to arm.
    waiting: Vec<(bool, RmwRequestId)>,
    /// Name of the base, and of the joints in the order of their velocities.
    base: String,
    names: Vec<String>,
    tip: Option<usize>,
    fault: Option<MotionFault>,
}

impl MotionNode {
    /// Offers everything; `tip` is the number of the link whose velocity is published.
    pub fn open(mut node: RosNode, control: &MotionControl, tip: Option<usize>) -> Result<MotionNode> {
        for topic in &MOTION_PUBLISHED {
            node.offer(topic, "")?;
        }
        let robot = control.robot();
        let base = robot.links().first().map_or(String::new(), |link| link.name.clone());
        let names = robot.free().iter().map(|joint| robot.joints()[*joint].name.clone()).collect();
        let (joints, arm, disarm) =
            (node.subscribe(&JOINT_STATES, "")?, node.serve(&ARM)?, node.serve(&DISARM)?);
        Ok(MotionNode { node, joints, arm, disarm, waiting: Vec::new(), base, names, tip, fault: None })
    }

    /// Takes joint states and calls that have come. Returns what is asked: true to arm, false to disarm; each is to be
    /// [answered](MotionNode::answer) in this order.
    pub fn turn(&mut self, feed: &mut MotionFeed, now_us: u64) -> Vec<bool> {
        for state in received(&self.joints) {
            let at_us = match at(state.header.stamp, JointTime::Host) {
                JointTime::Host(us) => us,
                _ => now_us,
            };
            let named = state.name.iter().zip(&state.position);
            feed.take_joints(at_us, named.map(|(name, position)| (name.as_str(), *position)));
        }
        // A call to disarm goes before one to arm: whoever asks for it is obeyed.
        self.waiting.extend(calls(&self.disarm).map(|(id, _)| (false, id)));
        self.waiting.extend(calls(&self.arm).map(|(id, _)| (true, id)));
        self.waiting.iter().map(|(arms, _)| *arms).collect()
    }

    /// Answers the calls of the last turn.
    pub fn answer(&mut self, answers: Vec<Result<(), MotionFault>>) {
        for ((arms, id), answer) in std::mem::take(&mut self.waiting).into_iter().zip(answers) {
            let message =
                answer.map_or_else(|fault| format!("not armed: {}", fault.as_str()), |()| "done".into());
            let server = if arms { &self.arm } else { &self.disarm };
            // Who asked may be gone.
            let _ = server.send_response(id, Done { success: answer.is_ok(), message });
        }
    }

    /// Publishes a command. Disarmed, it says nothing but that: whoever moves the robot has it.
    pub fn publish(&mut self, command: &MotionCommand, feed: &MotionFeed, line: &str, us: u64) -> Result<()> {
        if command.fault != self.fault {
            self.fault = command.fault;
            let said =
                |fault: MotionFault| self.node.log(LogLevel::Error, &format!("stopped: {}", fault.as_str()));
            command.fault.map(said);
        }
        self.node.publish(&MOTION, "", messages::text(line))?;
        let wrench = feed.wrench().map(|part| part.to_array());
        self.node.publish(&TOUCH_WRENCH, "", motion::two_vectors(us, &self.base, wrench))?;
        let Some(speed) = command.speed.filter(|_| command.phase != MotionPhase::Disarmed) else {
            return Ok(());
        };
        let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let velocities = &command.velocities;
        self.node.publish(&SPEED_SCALING, "", motion::speed_scaling(speed))?;
        let jog = motion::joint_jog(us, &self.base, &names, velocities, HOLDS_S);
        self.node.publish(&JOINT_JOG, "", jog)?;
        self.node.publish(&VELOCITIES, "", motion::velocities(velocities))?;
        if let Some(tip) = self.tip {
            let twist = feed.twist(tip, velocities).map(|part| part.to_array());
            self.node.publish(&TWIST, "", motion::two_vectors(us, &self.base, twist))?;
        }
        Ok(())
    }
}
