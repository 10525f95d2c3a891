//! The recording of one board: a file of its own, or its part of a robot's.

use super::board_names::{WIRE, attachment_of, boards, of_board};
use super::overview::Overview;
use crate::error::{RecordingError, Result, UsageError};
use crate::text::words;
use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};

/// Place of a recorded board, as text `FILE`, or `FILE#BOARD` for a board of a robot.
///
/// A part after the last `#` that cannot be the name of a board, such as `b.mcap`, belongs to the name of the
/// file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoardRecording {
    /// The file.
    pub path: PathBuf,
    /// The board, of the recording of a robot.
    pub board: Option<String>,
}

impl<T: Into<OsString>> From<T> for BoardRecording {
    fn from(text: T) -> BoardRecording {
        let text = text.into();
        match text.to_str().and_then(|text| text.rsplit_once('#')) {
            Some((path, board)) if !path.is_empty() && is_board(board) => {
                BoardRecording { path: path.into(), board: Some(board.into()) }
            }
            _ => BoardRecording { path: text.into(), board: None },
        }
    }
}

impl fmt::Display for BoardRecording {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BoardRecording { path, board } = self;
        match board {
            Some(board) => write!(f, "{}#{board}", path.display()),
            None => write!(f, "{}", path.display()),
        }
    }
}

impl BoardRecording {
    /// The recordings of all boards in a file, in its order; none if it is not a recording of taxel.
    pub fn all(path: &Path, overview: &Overview) -> Vec<BoardRecording> {
        let of_robot = boards(overview.topics()).into_iter().map(|board| Some(board.to_string()));
        let alone = overview.topics().any(|topic| topic == WIRE).then_some(None);
        of_robot.chain(alone).map(|board| BoardRecording { path: path.into(), board }).collect()
    }

    /// The topic of this board that the recording of a single board calls so.
    pub fn topic(&self, topic: &str) -> String {
        of_board(self.board.as_deref(), topic)
    }

    /// The attachment, or the metadata, of this board that the recording of a single board calls so.
    pub fn attachment(&self, name: &str) -> String {
        attachment_of(self.board.as_deref(), name)
    }

    /// Returns what the file holds. Error if it is of a robot, and the board is not named or not among its boards.
    pub fn overview(&self) -> Result<Overview> {
        let overview = Overview::of(&self.path)?;
        self.check(&overview)?;
        Ok(overview)
    }

    fn check(&self, overview: &Overview) -> Result<()> {
        let path = self.path.display();
        let is_alone = overview.topics().any(|topic| topic == WIRE);
        match (&self.board, &boards(overview.topics())[..]) {
            (Some(board), []) if is_alone => {
                fail!(UsageError::Unknown, "{path} is of a single board: leave out #{board}")
            }
            (Some(_), []) => Err(RecordingError::NotTaxel { path: self.path.clone(), topic: WIRE }.into()),
            (Some(board), of_robot) if !of_robot.contains(&board.as_str()) => {
                let known = of_robot.iter().copied();
                fail!(UsageError::Unknown, "{path}: {}", words::unknown("board", board, known))
            }
            (None, of_robot @ [first, ..]) if !is_alone => {
                let all = of_robot.join(", ");
                fail!(UsageError::Argument, "{path} is of a robot's boards, {all}: name one, {path}#{first}")
            }
            _ => Ok(()),
        }
    }
}

/// True if this can be the name of a board of a robot: letters, digits, `_` and `-`. A dot makes it a part of
/// a file's name.
pub(crate) fn is_board(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|sign| sign.is_ascii_alphanumeric() || matches!(sign, '_' | '-'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_board_is_named_behind_the_file() {
        let read = |text: &str| {
            let BoardRecording { path, board } = text.into();
            (path.display().to_string(), board)
        };
        assert_eq!(read("a.mcap"), ("a.mcap".into(), None));
        assert_eq!(read("a.mcap#left-arm"), ("a.mcap".into(), Some("left-arm".into())));
        assert_eq!(read("a#b.mcap"), ("a#b.mcap".into(), None));
        assert_eq!(read("a#b.mcap#c"), ("a#b.mcap".into(), Some("c".into())));
        for whole in ["#a", "a#", "#"] {
            assert_eq!(read(whole), (whole.into(), None));
        }
        let hand = BoardRecording::from("a.mcap#hand");
        assert_eq!(hand.to_string(), "a.mcap#hand");
        assert_eq!(
            (hand.topic(WIRE), hand.attachment("garment.toml")),
            ("/taxel/hand/wire".into(), "hand/garment.toml".into())
        );
    }
}
