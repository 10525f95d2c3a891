//! Errors about a map, with their place in its file.

use crate::error::{Error, ErrorKind, MapFileError};
use crate::text::toml_key::line_in;
use crate::text::words::Step;
use std::fmt::Display;

/// Error about the value at the end of these steps from the top of the file.
pub fn wrong(at: &[Step<'static>], why: impl Display) -> Error {
    MapFileError::Value { key: path(at), text: why.to_string() }.into()
}

/// The steps as a path: `concept[1].name`.
fn path(at: &[Step<'static>]) -> String {
    let mut path = String::new();
    for step in at {
        match step {
            Step::Key(key) if path.is_empty() => path += key,
            Step::Key(key) => path += &format!(".{key}"),
            Step::At(index) => path += &format!("[{index}]"),
        }
    }
    path
}

/// Prefixes the error with file, line and key.
pub fn located(error: Error, text: &str, file: &str) -> Error {
    let place = |key: &str| {
        let line = line_in(text, key)?;
        // Of `edge[2].from` the last key, of `edge[2]` the list.
        let last = key.rsplit('.').next().and_then(|part| part.split('[').next()).unwrap_or(key);
        Some(format!("{file}, line {line}, `{last}`: {error:#}"))
    };
    match error.kind() {
        ErrorKind::Map(MapFileError::Value { key, .. }) => {
            place(key).map(|text| MapFileError::Value { key: key.clone(), text }.into())
        }
        ErrorKind::Map(MapFileError::Version { found, .. }) => {
            place("version").map(|text| MapFileError::Version { found: *found, text }.into())
        }
        _ => None,
    }
    .unwrap_or_else(|| error.context(file))
}
