//! Errors in the words of the user instead of those of libraries: `must be a whole number from 0 to 255, not
//! "a"` instead of `invalid type: string "a", expected u8`.
//!
//! Parsers of user files turn the reader's error into a sentence by [`toml`] or [`json`], which name file,
//! line and key. All other errors are translated when they are printed, by [`sentence`].

mod json;
mod meant;
mod place;
mod printable;
mod serde;
mod toml;

pub use super::words::json::json;
pub use super::words::meant::{meant, unknown};
pub use super::words::place::Step;
pub(crate) use super::words::place::line_of;
pub use super::words::printable::{printable, printable_json};
pub use super::words::serde::plain;
pub use super::words::toml::toml;

use std::error::Error;

/// Formats an error and its causes as one sentence on one line, without control characters: causes quote
/// files and boards.
pub fn sentence(error: &(dyn Error + 'static)) -> String {
    let mut causes: Vec<String> = chain(error).map(cause).collect();
    // Some libraries quote their cause in addition to returning it.
    causes.dedup_by(|cause, quoting| quoting.ends_with(cause.as_str()));
    let line = causes.join(": ").lines().map(str::trim).collect::<Vec<_>>().join(" ");
    printable(&line).into_owned()
}

/// An error and its causes, from the outermost to the first.
pub fn chain<'a>(error: &'a (dyn Error + 'static)) -> impl Iterator<Item = &'a (dyn Error + 'static)> {
    std::iter::successors(Some(error), |&error| error.source())
}

/// Formats one error without its causes.
pub fn cause(error: &(dyn Error + 'static)) -> String {
    if let Some(other) = error.downcast_ref::<crate::Error>().and_then(crate::Error::bare) {
        return cause(other);
    }
    if let Some(error) = error.downcast_ref::<serde_json::Error>() {
        return json::without_text(error);
    }
    if let Some(error) = error.downcast_ref::<::toml::de::Error>() {
        return plain(error.message());
    }
    io(&error.to_string(), cfg!(windows))
}

/// Numbers of errors on Windows, and what other systems say of the same: a sentence is the same everywhere.
const WINDOWS: [(&str, &str); 6] = [
    ("2", "no such file or directory"),
    ("3", "no such file or directory"),
    ("5", "permission denied"),
    ("112", "no space left on device"),
    ("10054", "connection reset by peer"),
    ("10061", "connection refused"),
];

/// The system's message without its number, in lower case.
fn io(message: &str, is_windows: bool) -> String {
    match message {
        "stream did not contain valid UTF-8" => return "it is not text (UTF-8)".into(),
        "failed to fill whole buffer" => return "it ends too early".into(),
        _ => {}
    }
    let mut text = message.trim_start_matches("i/o error: ").to_string();
    while let Some((before, after)) = text.split_once(" (os error ") {
        let Some((number, rest)) = after.split_once(')') else { break };
        // The text before the number is a sentence of the system, which Windows ends itself.
        let (begin, said) = before
            .rsplit_once(": ")
            .map_or(("", before), |(_, said)| before.split_at(before.len() - said.len()));
        let known = WINDOWS.iter().find(|(of, _)| is_windows && *of == number).map(|(_, words)| *words);
        let said = known.unwrap_or(said.trim_end_matches('.'));
        let mut letters = said.chars();
        let first = letters.next().map(|first| first.to_lowercase().to_string()).unwrap_or_default();
        text = format!("{begin}{first}{}{rest}", letters.as_str());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Context;

    #[test]
    fn causes_are_reported_without_numbers_of_the_system() {
        let missing = std::io::Error::from_raw_os_error(2);
        let flat = crate::Error::other(format!("tcp:a:1 cannot be reached: {missing}"));
        assert_eq!(sentence(&flat), "tcp:a:1 cannot be reached: no such file or directory");
        let deep = crate::Error::from(missing).context("x.toml cannot be read");
        assert_eq!(sentence(&deep), "x.toml cannot be read: no such file or directory");
        let windows = "x.toml cannot be read: The system cannot find the file specified. (os error 2): y";
        assert_eq!(io(windows, true), "x.toml cannot be read: no such file or directory: y");
        let other = "x.toml cannot be read: The handle is invalid. (os error 6): y";
        assert_eq!(io(other, true), "x.toml cannot be read: the handle is invalid: y");
        assert_eq!(io("No such process (os error 3)", false), "no such process");
        let number = serde_json::from_str::<u8>("-3").context("age").unwrap_err();
        assert_eq!(
            sentence(&number),
            "age: line 1, character 2: must be a whole number from 0 to 255, not -3"
        );
    }
}
