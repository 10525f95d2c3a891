//! The node of a robot: what touches all of its boards, and which of them are not there.

use super::node::RosNode;
use anyhow::Result;
use ros2_client::log::LogLevel;
use std::time::{Duration, Instant};
use taxel::client::clock::SteadyTime;
use taxel::robot::{BoardEvent, BoardScan, ReadRobot, RobotContacts, RobotEvent, robot_contacts_message};
use taxel::ros2::messages::{self, BoardState};
use taxel::ros2::topics::{DIAGNOSTICS, ROBOT_CONTACTS};
use taxel::tell::words;

/// Time between two diagnostics of a board that is not there.
const PERIOD: Duration = Duration::from_secs(1);

/// Publishes what the nodes of the boards cannot.
pub struct RobotNode<'a> {
    node: RosNode,
    robot: &'a ReadRobot,
    /// None if no boards are sewn together.
    contacts: Option<RobotContacts>,
    /// Why a board is not there; none if it is.
    gone: Vec<Option<String>>,
    time: SteadyTime,
    told: Instant,
}

impl<'a> RobotNode<'a> {
    /// Offers everything.
    pub fn open(mut node: RosNode, robot: &'a ReadRobot) -> Result<RobotNode<'a>> {
        node.offer(&DIAGNOSTICS, "")?;
        let contacts = (!robot.seams.is_empty()).then(|| RobotContacts::new(robot));
        if contacts.is_some() {
            node.offer(&ROBOT_CONTACTS, "")?;
        }
        let gone = vec![None; robot.boards.len()];
        Ok(RobotNode { node, robot, contacts, gone, time: SteadyTime::start(), told: Instant::now() })
    }

    /// Handles an event of a board.
    pub fn event(&mut self, event: &RobotEvent<BoardScan>) -> Result<()> {
        let gone = match &event.what {
            BoardEvent::News(_) | BoardEvent::Dropped { .. } => None,
            BoardEvent::Met | BoardEvent::Back { .. } => Some(None),
            BoardEvent::Absent { why } | BoardEvent::Lost { why, .. } | BoardEvent::Other { why } => {
                Some(Some(why.clone()))
            }
            BoardEvent::Over => Some(Some("its stream has ended".into())),
            BoardEvent::Failed(error) => Some(Some(words::sentence(error))),
        };
        if let Some(gone) = gone {
            if let Some(why) = &gone {
                let name = &self.robot.boards[event.board].name;
                self.node.log(LogLevel::Warn, &format!("board {name}: {why}"));
            }
            self.gone[event.board] = gone;
        }
        self.join(event)
    }

    /// Publishes the robot's contacts, if the event has changed them.
    fn join(&mut self, event: &RobotEvent<BoardScan>) -> Result<()> {
        let (Some(contacts), host_us) = (&mut self.contacts, event.stamp.host_us) else { return Ok(()) };
        let joined = match &event.what {
            BoardEvent::News(scan) => contacts.scan(event.board, scan, host_us),
            _ if self.gone[event.board].is_some() => contacts.forget(event.board, host_us),
            _ => Vec::new(),
        };
        if joined.is_empty() {
            return Ok(());
        }
        self.node.publish(&ROBOT_CONTACTS, "", robot_contacts_message(self.robot, host_us, &joined))
    }

    /// Publishes the diagnostics of boards that are not there, if they are due.
    pub fn turn(&mut self) -> Result<()> {
        if self.told.elapsed() < PERIOD {
            return Ok(());
        }
        self.told = Instant::now();
        let now_us = self.time.now_us();
        for (board, why) in self.robot.boards.iter().zip(&self.gone) {
            if let Some(why) = why {
                let told = messages::diagnostics(&board.name, now_us, "", BoardState::Lost(why));
                self.node.publish(&DIAGNOSTICS, "", told)?;
            }
        }
        Ok(())
    }
}
