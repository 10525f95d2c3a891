//! Robots' files, checked.

use super::board::RobotBoard;
use super::board_reader::{BoardReader, ConfigPlace};
use super::config::{BoardConfig, RobotConfig};
use super::place::RobotText;
use crate::body::posture::Motion;
use crate::body::robot::{self, Robot};
use crate::error::{Context, MapFileError, Result};
use crate::fcm::load;
use crate::fcm::map::MapFile;
use crate::fcm::unite::{EdgeConflict, United, unite};
use crate::files::input;
use crate::session::POSES;
use std::path::Path;
use std::sync::Arc;

/// Maps of a robot that names none.
const MAPS: [&str; 2] = ["robot", "probe"];

/// A robot's file, checked.
#[derive(Debug, Clone)]
pub struct ReadRobot {
    /// Path of the file.
    pub file: String,
    /// Text of the file, with its comments.
    pub text: String,
    /// Name of the robot.
    pub name: String,
    /// Description of the robot, if it names one.
    pub robot: Option<Arc<Robot>>,
    /// Poses of its links per second.
    pub poses: Option<f64>,
    /// Bounds on the motion of its joints.
    pub motion: Option<Motion>,
    /// Meaning of touches to it.
    pub map: MapFile,
    /// Boards, in the order of the file; at least one.
    pub boards: Vec<RobotBoard>,
    /// Every file that was read, which no output may replace.
    pub inputs: Vec<String>,
}

impl ReadRobot {
    /// True if its boards are at one time: real ones always are, simulations and recordings at real time.
    pub fn is_at_one_time(&self, realtime: bool) -> bool {
        realtime || self.boards.iter().all(RobotBoard::is_real)
    }

    /// Reads a robot's file and the files that it names. Errors name file, line, board and key.
    pub fn read(path: &Path) -> Result<ReadRobot> {
        ReadRobot::read_with(path, &BoardConfig::default())
    }

    /// Reads a robot's file, each of whose boards that listens is asked what `more` says in place of its own; paths
    /// of `more` are those of the working folder.
    pub fn read_with(path: &Path, more: &BoardConfig) -> Result<ReadRobot> {
        let file = path.display().to_string();
        let text = input::text(path).with_context(|| format!("{file} cannot be read"))?;
        ReadRobot::parse_with(file, text, path.parent().unwrap_or(Path::new("")), more)
    }

    /// Reads the text of a robot's file, whose paths are relative to `folder`. `file` names it in errors.
    pub fn parse(file: String, text: String, folder: &Path) -> Result<ReadRobot> {
        ReadRobot::parse_with(file, text, folder, &BoardConfig::default())
    }

    fn parse_with(file: String, text: String, folder: &Path, more: &BoardConfig) -> Result<ReadRobot> {
        let place = RobotText { file: &file, text: &text };
        let config = place.parse()?;
        if config.name.is_empty() {
            return Err(place.error("name", "the robot has no name").into());
        }
        if config.boards.is_empty() {
            return Err(place.error("boards", "the robot has no boards").into());
        }
        if config.poses.is_some_and(|hz| !POSES.contains(&hz)) {
            let why = format!("must be {} to {} per second", POSES.start(), POSES.end());
            return Err(place.error("poses", why).into());
        }
        let mut inputs = vec![file.clone()];
        let mut beside = |named: &str| {
            let path = input::beside(folder, named);
            inputs.push(path.clone());
            path
        };
        let described = config.urdf.as_deref().map(|urdf| robot::read(&beside(urdf)));
        let described =
            described.transpose().with_context(|| place.error("urdf", "the robot"))?.map(Arc::new);
        let maps: Result<Vec<MapFile>> = match &config.maps {
            Some(maps) => maps.iter().map(|map| load::map(&beside(map))).collect(),
            None => MAPS.into_iter().map(load::map).collect(),
        };
        let map = maps.and_then(united).with_context(|| place.error("maps", "the map of the robot"))?;
        let mut boards: Vec<RobotBoard> = Vec::new();
        for (index, board) in config.boards.iter().enumerate() {
            let of = ConfigPlace::File { text: place, index, boards: config.boards.len() };
            let asked = board.resolved(&mut beside);
            let asked = if asked.listens() { asked.with(more) } else { asked };
            let read = BoardReader { config: &asked, place: of, robot: described.as_ref() }.read()?;
            of.check_alone(&read, &boards)?;
            boards.push(read);
        }
        let RobotConfig { name, poses, motion, .. } = config;
        inputs.extend(more.files().iter().map(|path| path.display().to_string()));
        Ok(ReadRobot { name, robot: described, poses, motion, map, boards, inputs, text, file })
    }

    /// Number of the board of this name.
    pub fn board(&self, name: &str) -> Option<usize> {
        self.boards.iter().position(|board| board.name == name)
    }
}

/// Maps as one, by the concepts that they have in common. Error if they contradict each other.
fn united(maps: Vec<MapFile>) -> Result<MapFile> {
    let United { map, conflicts, .. } = unite(&maps, "robot", EdgeConflict::Agree)?;
    require!(conflicts.is_empty(), MapFileError::Unanswerable, "{}", conflicts.join("; "));
    Ok(map)
}
