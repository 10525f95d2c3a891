//! The robot of a command, and what its boards are asked instead of what its file says.

use super::requests::RequestLines;
use crate::fault::Fault;
use anyhow::{Result, bail};
use clap::Args;
use std::path::PathBuf;
use std::str::FromStr;
use taxel::robot::{ReadRobot, RobotBoard};
use taxel::source::SceneFile;
use taxel::tell::words;

/// A robot, and what is asked of its boards.
#[derive(Debug, Clone, Args)]
pub struct RobotFileArgs {
    /// The robot's file: robot.toml
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Take the mean of the first N frames as the baseline, 0 to 4096: of all boards, or of this one
    #[arg(long, value_name = "[BOARD=]N")]
    pub tare: Vec<ForBoards<u16>>,
    /// Scene to send to all boards, or to this one: a TOML file
    #[arg(long, value_name = "[BOARD=]FILE")]
    pub scene: Vec<ForBoards<PathBuf>>,
    /// Ask boards while they are followed, by lines: tare [BOARD] [N], scene [BOARD] FILE, self-test [BOARD],
    /// told NAME VALUE [AGE_MS]; - is the standard input
    #[arg(long, value_name = "FILE")]
    pub requests: Option<PathBuf>,
}

/// A value for all boards, or for one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ForBoards<T> {
    /// Name of the board; none for all.
    pub board: Option<String>,
    /// The value.
    pub value: T,
}

impl<T: FromStr> FromStr for ForBoards<T> {
    type Err = T::Err;

    fn from_str(text: &str) -> Result<ForBoards<T>, T::Err> {
        let (board, value) = text.split_once('=').map_or((None, text), |(board, value)| (Some(board), value));
        Ok(ForBoards { board: board.map(String::from), value: value.parse()? })
    }
}

impl<T> ForBoards<T> {
    /// The boards that are meant. Error if there is no board of this name, or it does not listen.
    fn of<'a>(&self, option: &str, robot: &'a mut ReadRobot) -> Result<Vec<&'a mut RobotBoard>> {
        let Some(name) = &self.board else {
            return Ok(robot.boards.iter_mut().filter(|board| board.listens()).collect());
        };
        let Some(number) = robot.board(name) else {
            let names = robot.boards.iter().map(|board| board.name.as_str());
            bail!(Fault::usage(format!("{option}: {}", words::unknown("board", name, names))));
        };
        let board = &mut robot.boards[number];
        if !board.listens() {
            let source = &board.source;
            bail!(Fault::usage(format!(
                "{option}: board {name}: {source} is a recording, whose board does not listen"
            )));
        }
        Ok(vec![board])
    }
}

impl RobotFileArgs {
    /// Opens the lines with which boards are asked later.
    pub fn requests(&self) -> Result<Option<RequestLines>> {
        self.requests.as_deref().map(RequestLines::open).transpose()
    }

    /// Reads the file, with what is asked instead.
    pub fn read(&self) -> Result<ReadRobot> {
        let mut robot = ReadRobot::read(&self.file)?;
        for tare in &self.tare {
            if tare.value > 4096 {
                bail!(Fault::usage(format!("--tare {}: it must be 0 to 4096", tare.value)));
            }
            tare.of("--tare", &mut robot)?.into_iter().for_each(|board| board.tare = Some(tare.value));
        }
        for scene in &self.scene {
            let file = SceneFile::read(&scene.value)?;
            scene.of("--scene", &mut robot)?.into_iter().for_each(|board| board.scene = Some(file.clone()));
            robot.inputs.push(scene.value.display().to_string());
        }
        let requests = self.requests.iter().filter(|path| path.as_os_str() != "-");
        robot.inputs.extend(requests.map(|path| path.display().to_string()));
        Ok(robot)
    }
}
