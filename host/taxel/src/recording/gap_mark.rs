//! Gaps of a board's stream, as a recording holds them.

use super::board_recording::BoardRecording;
use super::messages::{Message, Messages};
use crate::client::{Client, Event};
use crate::error::Result;
use serde::Deserialize;
use std::time::Duration;

/// Topic of the beginnings of gaps.
pub const LOST: &str = "/taxel/lost";
/// Topic of their ends.
pub const BACK: &str = "/taxel/back";

/// Begin or end of a gap.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum GapMark {
    /// The board is lost.
    Lost {
        /// The reason, a sentence.
        why: String,
        /// Host time at which the board was last heard, us since 1970.
        since_us: u64,
    },
    /// The board is back.
    Back {
        /// Sentence on whether it had restarted and what was set again.
        how: String,
        /// Time for which it was lost, s.
        after_s: f64,
    },
}

impl GapMark {
    /// Hands it to a client as if it happened now: what is present ends with the loss.
    pub fn apply(self, client: &mut Client) {
        match self {
            GapMark::Lost { why, since_us } => client.lost(why, since_us),
            GapMark::Back { how, after_s } => {
                let after = Duration::try_from_secs_f64(after_s).unwrap_or_default();
                client.say(Event::Back { how, after });
            }
        }
    }
}

/// Reads the begins and ends of a board's gaps, each with the host's time, ns.
pub fn gap_marks(recording: &BoardRecording) -> Result<Vec<(u64, GapMark)>> {
    let topics = [LOST, BACK].map(|topic| recording.topic(topic));
    let (mut messages, mut marks) = (Messages::of_topics(&recording.path, &topics)?, Vec::new());
    while let Some(Message { header, data }) = messages.next_message()? {
        marks.extend(serde_json::from_slice(data).ok().map(|mark| (header.log_time, mark)));
    }
    Ok(marks)
}
