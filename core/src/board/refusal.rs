//! Why a request is refused.

use super::Sentence;
use core::fmt::{self, Write};

/// Why something is refused, as a sentence.
#[derive(Debug, Clone)]
pub(super) struct Refusal(pub(super) Sentence);

impl Refusal {
    /// The sentence of an error.
    pub fn of(error: impl fmt::Display) -> Refusal {
        format_args!("{error}").into()
    }

    /// The sentence.
    pub fn sentence(&self) -> &str {
        &self.0
    }
}

impl From<fmt::Arguments<'_>> for Refusal {
    fn from(text: fmt::Arguments<'_>) -> Refusal {
        let mut sentence = Sentence::new();
        // What is too long is cut at the piece that does not fit.
        let _ = sentence.write_fmt(text);
        Refusal(sentence)
    }
}
