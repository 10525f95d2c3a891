//! Places and causes of errors in JSON.

use super::plain;

/// Formats an error in the text of a file as `FILE, line 3, `key`: ...`.
pub fn json(error: &serde_json::Error, text: &str, file: &str) -> String {
    let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or("");
    let before = line.get(..error.column().min(line.len())).unwrap_or(line);
    match key(before) {
        Some(key) if error.is_data() => {
            format!("{file}, line {}, `{key}`: {}", error.line(), reported(error))
        }
        _ => format!("{file}, {}", without_text(error)),
    }
}

/// The last key before a value: the text in quotes before a colon.
fn key(before: &str) -> Option<&str> {
    let (key, _) = before.rsplit_once(':')?;
    key.trim_end().strip_suffix('"')?.rsplit_once('"').map(|(_, key)| key)
}

/// Formats an error without a file, or without its text.
pub(super) fn without_text(error: &serde_json::Error) -> String {
    match (error.line(), error.column()) {
        (0, _) => reported(error),
        (line, column) => format!("line {line}, character {column}: {}", reported(error)),
    }
}

/// The message without its place.
fn reported(error: &serde_json::Error) -> String {
    let whole = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = whole.strip_suffix(&place).unwrap_or(&whole);
    let missing = |what: &str| format!("{what} is missing");
    match message {
        "expected value" => missing("a value"),
        "key must be a string" => "a key must be in quotes".into(),
        "trailing characters" => "there is text behind the end".into(),
        "trailing comma" => "there is a comma before a closing bracket".into(),
        "recursion limit exceeded" => "it is nested too deeply".into(),
        _ => match (message.strip_prefix("EOF while parsing "), message.strip_prefix("expected `")) {
            (Some(inside), _) => format!("it ends within {inside}"),
            (_, Some(_)) => missing(message.trim_start_matches("expected ")),
            _ => plain(message),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn wrong(text: &str) -> String {
        json(&serde_json::from_str::<BTreeMap<String, u8>>(text).unwrap_err(), text, "a.json")
    }

    #[test]
    fn line_and_key_are_named() {
        assert_eq!(
            wrong("{\n  \"a\": 1,\n  \"b\": 300\n}"),
            "a.json, line 3, `b`: must be a whole number from 0 to 255, not 300"
        );
        assert_eq!(wrong("{\"a\": "), "a.json, line 1, character 6: it ends within a value");
        assert_eq!(wrong("{\"a\": ]"), "a.json, line 1, character 7: a value is missing");
        assert_eq!(wrong("{\"a\" 3}"), "a.json, line 1, character 6: `:` is missing");
        assert_eq!(wrong("{a: 3}"), "a.json, line 1, character 2: a key must be in quotes");
        assert_eq!(wrong("[]"), "a.json, line 1, character 0: must be a table, not a list");
    }
}
