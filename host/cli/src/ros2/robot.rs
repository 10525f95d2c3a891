//! The node of a robot: what touches on all of its boards mean, and which of them are not there.

use super::host_input::HostInputTopics;
use super::node::RosNode;
use anyhow::Result;
use ros2_client::log::LogLevel;
use std::time::{Duration, Instant};
use taxel::mind::{BoardSense, RobotMeaning, RobotMeaningLine, RobotMind, robot_intent_message};
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotEvent, RobotStream};
use taxel::ros2::messages::{self, DiagnosticState};
use taxel::ros2::topics::{DIAGNOSTICS, ROBOT_INTENT};
use taxel::text::words;

/// Time between two diagnostics of a board that is not there.
const PERIOD: Duration = Duration::from_secs(1);

/// Publishes what the nodes of the boards cannot.
pub struct RobotNode<'a> {
    node: RosNode,
    robot: &'a ReadRobot,
    mind: RobotMind,
    taken: HostInputTopics,
    /// Reason why each board is not there; none if it is.
    gone: Vec<Option<String>>,
    sent: Instant,
}

impl<'a> RobotNode<'a> {
    /// Offers everything. Error as of [`RobotMind::new`], or if the network refuses a topic.
    pub fn open(mut node: RosNode, robot: &'a ReadRobot) -> Result<RobotNode<'a>> {
        node.offer(&DIAGNOSTICS, "")?;
        node.offer(&ROBOT_INTENT, "")?;
        let mind = RobotMind::new(robot)?;
        let taken = HostInputTopics::open(&mut node, robot, &mind)?;
        let gone = vec![None; robot.boards.len()];
        Ok(RobotNode { node, robot, mind, taken, gone, sent: Instant::now() })
    }

    /// The mind of the robot, to be given what others know; what it says then is for [`RobotNode::mean`].
    pub fn mind(&mut self) -> &mut RobotMind {
        &mut self.mind
    }

    /// Publishes what touches mean.
    pub fn mean(&mut self, meaning: &RobotMeaning) -> Result<()> {
        let line = RobotMeaningLine::of(&self.mind, meaning);
        self.node.publish(&ROBOT_INTENT, "", robot_intent_message(self.robot, &line))
    }

    /// Handles an event of a board.
    pub fn event(&mut self, event: &RobotEvent<BoardSense>) -> Result<()> {
        let gone = match &event.what {
            BoardEvent::News(_) | BoardEvent::State(BoardState::Dropped { .. }) => None,
            BoardEvent::State(state) => Some(match state {
                BoardState::Absent { why } | BoardState::Lost { why, .. } | BoardState::Other { why } => {
                    Some(why.clone())
                }
                BoardState::Over { .. } => Some("its stream has ended".into()),
                BoardState::Failed(error) => Some(words::sentence(error)),
                _ => None,
            }),
        };
        if let Some(gone) = gone {
            if let Some(why) = &gone {
                let name = &self.robot.boards[event.board].name;
                self.node.log(LogLevel::Warn, &format!("board {name}: {why}"));
            }
            self.gone[event.board] = gone;
        }
        match self.mind.event(event, |sense| Some(sense)).cloned() {
            Some(meaning) => self.mean(&meaning),
            None => Ok(()),
        }
    }

    /// Sends mind and boards what has come, and the mind that time passes, if no board says anything. Publishes
    /// what touches mean then if that is news, and the diagnostics of boards that are not there, if they are due.
    pub fn turn(&mut self, session: &RobotStream<BoardSense>, is_quiet: bool) -> Result<()> {
        let now_us = session.now_us();
        let mut news = self.taken.turn(&self.node, self.robot, &mut self.mind, session);
        if is_quiet {
            news = self.mind.pass(now_us).cloned().or(news);
        }
        news.map_or(Ok(()), |meaning| self.mean(&meaning))?;
        if self.sent.elapsed() < PERIOD {
            return Ok(());
        }
        self.sent = Instant::now();
        for (board, why) in self.robot.boards.iter().zip(&self.gone) {
            if let Some(why) = why {
                let sent = messages::diagnostics(&board.name, now_us, "", DiagnosticState::Lost(why));
                self.node.publish(&DIAGNOSTICS, "", sent)?;
            }
        }
        Ok(())
    }
}
