//! Reasons for which requests are refused.

use crate::format::{Invalid, LEFT_OUT};
use core::fmt::{self, Write};
use heapless::String;

/// A message text of the board, truncated to this length.
pub(super) type Sentence = String<112>;

/// Reason of a refusal, as a sentence.
#[derive(Debug, Clone)]
pub(super) struct Refusal(pub(super) Sentence);

impl Refusal {
    /// The message of an error.
    #[inline(never)] // M0+: out of line
    pub fn of(error: impl fmt::Display) -> Refusal {
        format_args!("{error}").into()
    }

    /// Refuses what this build leaves out.
    #[inline(never)] // M0+: out of line
    pub fn left_out(parameter: &'static str) -> Refusal {
        Refusal::of(Invalid { parameter, must: LEFT_OUT })
    }

    /// The sentence.
    pub fn sentence(&self) -> &str {
        &self.0
    }
}

impl From<fmt::Arguments<'_>> for Refusal {
    fn from(text: fmt::Arguments<'_>) -> Refusal {
        let mut sentence = Sentence::new();
        // A text that is too long is cut before the first piece that does not fit.
        let _ = sentence.write_fmt(text);
        Refusal(sentence)
    }
}
