//! Errors about a map, with their place in its file.

use crate::tell::words::{Step, line_of};
use anyhow::{Error, anyhow};
use std::fmt;

/// An error about one value of a map.
#[derive(Debug)]
pub struct Wrong {
    at: Vec<Step<'static>>,
    why: String,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}

impl std::error::Error for Wrong {}

/// Error about the value at the end of these steps from the top of the file.
pub fn wrong(at: &[Step<'static>], why: impl fmt::Display) -> Error {
    Wrong { at: at.to_vec(), why: why.to_string() }.into()
}

/// Prefixes the error with file, line and key.
pub fn located(error: Error, text: &str, file: &str) -> Error {
    let Some(found) = error.chain().find_map(|cause| cause.downcast_ref::<Wrong>()) else {
        return error.context(file.to_string());
    };
    let key = found.at.iter().rev().find_map(|step| match step {
        Step::Key(key) => Some(format!(", `{key}`")),
        Step::At(_) => None,
    });
    match line_of(text, &found.at) {
        Some(line) => anyhow!("{file}, line {line}{}: {error:#}", key.unwrap_or_default()),
        None => error.context(file.to_string()),
    }
}
