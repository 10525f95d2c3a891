//! Words from outside, without what a terminal would obey.

use std::borrow::Cow;
use std::fmt::Write;

/// What stands in the place of a sign that a terminal obeys.
const STANDS: &str = "?";

/// Whether a terminal obeys a sign, or shows what stands beside it elsewhere: control codes, ends of lines and
/// of paragraphs, turns of the direction of writing.
fn is_obeyed(sign: char) -> bool {
    let turns = matches!(sign, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    sign.is_control() || turns
}

/// The words with `?` for each sign that a terminal would obey.
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.contains(is_obeyed) { text.replace(is_obeyed, STANDS).into() } else { text.into() }
}

/// A line of JSON in which signs that a terminal would obey are escaped: it says the same.
pub fn printable_json(line: &str) -> Cow<'_, str> {
    if !line.contains(is_obeyed) {
        return line.into();
    }
    let mut escaped = String::with_capacity(line.len());
    for sign in line.chars() {
        if is_obeyed(sign) {
            // A string takes all, and all of these signs have four digits.
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
