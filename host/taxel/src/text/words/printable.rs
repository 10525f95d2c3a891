//! Text from outside, without control characters.

use std::borrow::Cow;
use std::fmt::Write;

/// Replacement of a control character.
const STANDS: &str = "?";

/// True for characters that control a terminal or move the text beside them: control codes, line and
/// paragraph separators, changes of writing direction.
fn is_obeyed(sign: char) -> bool {
    let turns = matches!(sign, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    sign.is_control() || turns
}

/// Replaces each control character by `?`.
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.contains(is_obeyed) { text.replace(is_obeyed, STANDS).into() } else { text.into() }
}

/// Escapes control characters in a line of JSON; the meaning stays the same.
pub fn printable_json(line: &str) -> Cow<'_, str> {
    if !line.contains(is_obeyed) {
        return line.into();
    }
    let mut escaped = String::with_capacity(line.len());
    for sign in line.chars() {
        if is_obeyed(sign) {
            // Writing to a string cannot fail, and all of these characters have four digits.
            let _ = write!(escaped, "\\u{:04x}", u32::from(sign));
        } else {
            escaped.push(sign);
        }
    }
    escaped.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_replaced_and_in_json_escaped() {
        assert!(matches!(printable("Füße, 足 5 °C"), Cow::Borrowed(_)));
        assert_eq!(printable("a\u{1b}[2Jb\r\n\u{9b}\u{202e}c\u{7f}"), "a?[2Jb????c?");
        let line = serde_json::json!({ "a": "\u{9b}2J\u{202e}\u{1b}\u{7f}ü" }).to_string();
        let escaped = printable_json(&line);
        assert!(!escaped.contains(is_obeyed), "{escaped}");
        let [before, after]: [serde_json::Value; 2] =
            [&line, &*escaped].map(|line| serde_json::from_str(line).unwrap());
        assert_eq!(before, after);
    }
}
