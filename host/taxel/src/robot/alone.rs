//! A board that is followed alone: configured by options or keywords, or one of a robot's file.

use super::board::RobotBoard;
use super::board_reader::{BoardReader, ConfigPlace};
use super::config::BoardConfig;
use super::file::ReadRobot;
use crate::error::{Result, UsageError};
use crate::source::SourceSpec;
use crate::text::words;

/// Reads a board's configuration. One of a robot's file is asked what the configuration says in place of its own.
/// Error if the file has several boards and none of them is named.
pub fn read_board(config: &BoardConfig, place: ConfigPlace<'_>) -> Result<RobotBoard> {
    let Some(SourceSpec::Robot { file, board }) = &config.source else {
        return BoardReader { config, place, robot: None }.read();
    };
    let mut robot = ReadRobot::read_with(file, config)?;
    let names = || robot.boards.iter().map(|board| board.name.as_str());
    let number = match board {
        Some(name) => robot.board(name),
        None => (robot.boards.len() == 1).then_some(0),
    };
    let why = || match board {
        Some(name) => words::unknown("board", name, names()),
        None => {
            let (names, first) = (names().collect::<Vec<_>>().join(", "), &robot.boards[0].name);
            format!("its boards are {names}, and this takes one: name it, {}#{first}", robot.file)
        }
    };
    match number {
        Some(number) => Ok(robot.boards.swap_remove(number)),
        None => fail!(UsageError::Argument, "{}: {}", robot.file, why()),
    }
}
