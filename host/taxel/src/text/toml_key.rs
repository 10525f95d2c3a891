//! Errors about a key of a TOML file, with its line.

use super::words::{Step, line_of};
use crate::error::SettingError;
use std::fmt::Display;

/// Error about a key of a file, in one sentence: ``mine.toml, line 12, `blocks[3].input`: ...``. A path is
/// keys joined by dots, with indices from 0. If the file has only a part of the path, the line is that of
/// this part.
pub fn error(file: &str, text: &str, path: &str, error: impl Display) -> SettingError {
    let text = match line_in(text, path) {
        Some(line) => format!("{file}, line {line}, `{path}`: {error}"),
        None => format!("{file}, `{path}`: {error}"),
    };
    SettingError::Key { key: path.into(), text }
}

/// Line of a key in a text, or of the part of its path that the text has.
pub(crate) fn line_in(text: &str, path: &str) -> Option<usize> {
    let steps: Vec<Step<'_>> = steps(path).collect();
    line_of(text, &steps)
}

/// Splits `blocks[3].input` into `blocks`, 3, `input`.
fn steps(path: &str) -> impl Iterator<Item = Step<'_>> {
    path.split(['.', '[']).map(|part| match part.strip_suffix(']').and_then(|index| index.parse().ok()) {
        Some(index) => Step::At(index),
        None => Step::Key(part),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "name = \"a\"\nwiring.settle_ns = 3\n\n[[blocks]]\nrow = 0\n\n[[blocks]]\nrow = 4\n\
                        orientation = { mirror_x = true }\nlines = [\n  { pin = 1 },\n  { pin = 2 },\n]\n";

    #[test]
    fn an_error_names_file_line_and_path() {
        for (path, line) in [
            ("name", 1),
            ("wiring.settle_ns", 2),
            ("blocks[1].row", 8),
            ("blocks[1].columns", 7),
            ("blocks[1].orientation.mirror_y", 9),
            ("blocks[1].lines[1].pin", 12),
        ] {
            let said = error("x.toml", TEXT, path, "no").to_string();
            assert_eq!(said, format!("x.toml, line {line}, `{path}`: no"));
        }
        assert_eq!(error("x.toml", "a = = 1", "a", "no").to_string(), "x.toml, `a`: no");
    }
}
