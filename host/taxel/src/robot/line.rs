//! State of a board of a robot, as JSON.

use super::event::BoardState;
#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use crate::text::words;
use serde::Serialize;

/// State of a board of a robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("board")))]
#[serde(tag = "type", rename = "board")]
pub struct BoardLine<'a> {
    /// Name of the board.
    pub board: &'a str,
    /// `absent`, `met`, `lost`, `back`, `other`, `dropped`, `over` or `failed`.
    pub state: &'static str,
    /// The host's time, us since 1970.
    pub host_time_us: u64,
    /// Host time at which a lost board was last heard, us since 1970.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub since_us: Option<u64>,
    /// Time for which a board was gone that is back, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_s: Option<f64>,
    /// Images dropped so far.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub images: Option<u64>,
    /// Reason of the state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

impl<'a> BoardLine<'a> {
    /// The message of a state that began at a host time, us.
    pub fn of(board: &'a str, host_time_us: u64, state: &BoardState) -> BoardLine<'a> {
        let line = |state| {
            let (since_us, after_s, images, why) = (None, None, None, None);
            BoardLine { board, state, host_time_us, since_us, after_s, images, why }
        };
        let because = |line: BoardLine<'a>, why: &str| BoardLine { why: Some(why.into()), ..line };
        match state {
            BoardState::Absent { why } => because(line("absent"), why),
            BoardState::Met => line("met"),
            BoardState::Lost { since_us, why } => {
                because(BoardLine { since_us: Some(*since_us), ..line("lost") }, why)
            }
            BoardState::Back { after } => BoardLine { after_s: Some(after.as_secs_f64()), ..line("back") },
            BoardState::Other { why } => because(line("other"), why),
            BoardState::Dropped { images } => BoardLine { images: Some(*images), ..line("dropped") },
            BoardState::Over { remark } => BoardLine { why: remark.clone(), ..line("over") },
            BoardState::Failed(error) => because(line("failed"), &words::sentence(error)),
        }
    }
}
