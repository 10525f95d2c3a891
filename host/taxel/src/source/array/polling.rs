//! Requests that an array answers with a frame.

use super::description::ArrayDescription;
use crate::time::Instant;
use std::time::Duration;

/// Silence that ends an answer.
const QUIET: Duration = Duration::from_millis(30);
/// Time after which an answer is no longer awaited.
const ANSWER: Duration = Duration::from_secs(1);

/// Requests to the array, each once the last one was answered.
#[derive(Debug)]
pub struct Polling {
    text: Option<String>,
    every: Duration,
    asked: Option<Instant>,
    heard: Option<Instant>,
    is_answered: bool,
}

impl Polling {
    /// Requests of a description; none if it polls nothing.
    pub fn new(description: &ArrayDescription) -> Polling {
        let (text, every) = (description.link.poll.clone(), description.link.every_ms.into());
        Polling { text, every: Duration::from_millis(every), asked: None, heard: None, is_answered: true }
    }

    /// Text to send now.
    pub fn due(&mut self) -> Option<String> {
        let text = self.text.clone()?;
        let waited = self.asked.map_or(Duration::MAX, |asked| asked.elapsed());
        if waited < self.every || !self.is_answered && waited < ANSWER {
            return None;
        }
        (self.asked, self.is_answered) = (Some(Instant::now()), false);
        Some(text)
    }

    /// Notes that bytes have come.
    pub fn heard(&mut self) {
        self.heard = Some(Instant::now());
    }

    /// True once after bytes, when nothing has come for a while.
    pub fn is_quiet(&mut self) -> bool {
        let is_quiet = self.heard.is_some_and(|heard| heard.elapsed() >= QUIET);
        if is_quiet {
            (self.heard, self.is_answered) = (None, true);
        }
        is_quiet
    }
}
