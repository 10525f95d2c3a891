//! What a board's event says of touches, to the robot's contacts and to its mind.

use super::felt::{BoardSense, MindReader};
use crate::client::{Client, Event};
use crate::robot::{BoardScan, ReadRobot, ScanReader};

/// What a board's event says of touches.
#[derive(Debug, Clone, Default)]
pub struct BoardHeard {
    /// The scan that it is about.
    pub scan: Option<BoardScan>,
    /// What it says of touches to the mind.
    pub sense: Option<BoardSense>,
}

/// Reads a board's events for the robot, in the board's thread.
#[derive(Debug, Clone)]
pub struct HeardReader {
    scans: ScanReader,
    mind: Option<MindReader>,
}

impl HeardReader {
    /// Of a board of a robot; not for its mind if nobody wants to know what touches mean to the robot.
    pub fn new(robot: &ReadRobot, board: usize, is_minded: bool) -> HeardReader {
        let mind = is_minded.then(|| MindReader::new(robot, board));
        HeardReader { scans: ScanReader::new(robot, board), mind }
    }

    /// What an event says, which the client already includes.
    pub fn read(&mut self, client: &Client, event: &Event) -> BoardHeard {
        let scan = self.scans.scan(client, event);
        let sense = self.mind.as_mut().and_then(|mind| mind.sense(client, event, scan.as_ref()));
        BoardHeard { scan, sense }
    }
}
