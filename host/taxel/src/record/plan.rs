//! Plan of a recording: what is recorded, and where.

use super::limit::Rotate;
use super::provenance::Origin;
use crate::body::ReadBody;
use std::path::PathBuf;

/// Plan of a recording: what to record, and where.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// The first file.
    pub path: PathBuf,
    /// Extent after which another file follows.
    pub rotate: Option<Rotate>,
    /// True to write ROS 2 messages, too, into a file beside each.
    pub ros2: bool,
    /// Replace existing files.
    pub force: bool,
    /// Input files, which are never replaced.
    pub inputs: Vec<PathBuf>,
    /// The robot, if the boards are those of one.
    pub robot: Option<PlannedRobot>,
    /// The boards.
    pub boards: Vec<PlannedBoard>,
}

/// A robot that is to be recorded.
#[derive(Debug, Clone)]
pub struct PlannedRobot {
    /// Name of the robot.
    pub name: String,
    /// Text of its file, `robot.toml`.
    pub text: String,
}

/// A board that is to be recorded.
#[derive(Debug, Clone, Default)]
pub struct PlannedBoard {
    /// Name in the robot, below which its topics are; none of a board alone.
    pub name: Option<String>,
    /// Source of its stream; label and scale are those of its source once that is open.
    pub origin: Origin,
    /// Places of its panels on the robot, for the ROS 2 messages.
    pub body: Option<ReadBody>,
    /// True if it is there from the start, as a simulation or a recording is: the first file waits for it.
    pub is_there: bool,
}

impl Plan {
    /// One board, in one file.
    pub fn of(path: impl Into<PathBuf>, board: PlannedBoard) -> Plan {
        Plan { path: path.into(), boards: vec![board], ..Plan::default() }
    }
}
