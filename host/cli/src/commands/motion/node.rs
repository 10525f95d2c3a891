//! Commands of a ROS 2 node.

use super::follow::{Asked, Face};
use crate::ros2::MotionNode;
use anyhow::Result;
use std::sync::Arc;
use taxel::body::robot::Robot;
use taxel::motion::{MotionCommand, MotionFault, MotionFeed};

/// A node, and the robot whose joints it names.
pub struct NodeFace {
    /// The node.
    pub node: MotionNode,
    /// The robot.
    pub robot: Arc<Robot>,
}

impl Face for NodeFace {
    fn turn(&mut self, feed: &mut MotionFeed, now_us: u64) -> Vec<Asked> {
        let asked = self.node.turn(feed, now_us).into_iter();
        asked.map(|arms| if arms { Asked::Arm } else { Asked::Disarm }).collect()
    }

    fn answer(&mut self, answers: Vec<Result<(), MotionFault>>) {
        self.node.answer(answers);
    }

    fn command(&mut self, command: &MotionCommand, feed: &MotionFeed, now_us: u64) -> Result<()> {
        let line = command.line(&self.robot, now_us).to_string();
        self.node.publish(command, feed, &line, now_us)
    }
}
