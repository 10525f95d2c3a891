//! Places in a robot's file, for errors.

use super::config::{BoardConfig, RobotConfig};
use crate::error::SettingError;
use crate::text::{toml_key, words};
use serde::Deserialize;
use std::fmt::Display;

/// The file and its text.
#[derive(Debug, Clone, Copy)]
pub struct RobotText<'a> {
    /// Path of the file.
    pub file: &'a str,
    /// Text of the file.
    pub text: &'a str,
}

impl RobotText<'_> {
    /// Error about a key: ``robot.toml, line 12, `boards[1].source`: board arm: ...``.
    pub fn error(&self, key: &str, why: impl Display) -> SettingError {
        toml_key::error(self.file, self.text, key, why)
    }

    /// Error about a key of a board.
    pub fn of_board(&self, board: usize, name: &str, key: &str, why: impl Display) -> SettingError {
        self.error(&format!("boards[{board}].{key}"), format_args!("board {name}: {why}"))
    }

    /// The place of a key of a board, as the context of an error of the file that it names.
    pub fn place(&self, board: usize, name: &str, key: &str) -> String {
        let key = format!("boards[{board}].{key}");
        match toml_key::line_in(self.text, &key) {
            Some(line) => format!("{}, line {line}, `{key}`: board {name}", self.file),
            None => format!("{}, `{key}`: board {name}", self.file),
        }
    }

    /// Reads the text. Errors name the line, the key, and the board if it is one of a board.
    pub fn parse(&self) -> Result<RobotConfig, SettingError> {
        toml::from_str(self.text).map_err(|error| {
            let reported = words::toml(&error, self.text, self.file);
            let board =
                self.board_with(error.message()).map_or(String::new(), |name| format!(" (board {name})"));
            SettingError::Malformed(reported + &board)
        })
    }

    /// Name of the board that cannot be read for this reason.
    fn board_with(&self, why: &str) -> Option<String> {
        let read: toml::Table = toml::from_str(self.text).ok()?;
        let is_it = |board: &&toml::Value| {
            BoardConfig::deserialize((*board).clone()).is_err_and(|error| error.message() == why)
        };
        let board = read.get("boards")?.as_array()?.iter().find(is_it)?;
        Some(board.get("name")?.as_str()?.to_string())
    }
}
