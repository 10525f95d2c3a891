//! Places and causes of errors in TOML files.

use super::{place, plain};

/// Formats an error in the text of a file as `FILE, line 3, `key`: ...`.
pub fn toml(error: &toml::de::Error, text: &str, file: &str) -> String {
    let message = plain(error.message());
    let Some(span) = error.span() else { return format!("{file}: {message}") };
    let key = place::key_at(text, &span).filter(|key| !message.starts_with(&format!("`{key}`")));
    let key = key.map_or(String::new(), |key| format!(", `{key}`"));
    format!("{file}, line {}{key}: {message}", place::line(text, span.start))
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "it is read for its errors only")]
    struct Fault {
        pin: u8,
        kind: String,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "it is read for its errors only")]
    struct File {
        row: u8,
        #[serde(default)]
        pins: Vec<Fault>,
    }

    fn reported(text: &str) -> String {
        super::toml(&toml::from_str::<File>(text).unwrap_err(), text, "a.toml")
    }

    #[test]
    fn line_and_key_are_named() {
        assert_eq!(
            reported("pins = []\nrow = \"a\""),
            "a.toml, line 2, `row`: must be a whole number from 0 to 255, not \"a\""
        );
        assert_eq!(reported("pins = []"), "a.toml, line 1: `row` is missing");
        let inner =
            reported("row = 1\npins = [\n  { pin = 8, kind = \"open\" },\n  { pin = 8, kind = 3 },\n]");
        assert_eq!(inner, "a.toml, line 4, `kind`: must be a text, not 3");
        let listed = reported("row = 1\n[[pins]]\nkind = \"open\"\npin = 300\n");
        assert_eq!(listed, "a.toml, line 4, `pin`: must be a whole number from 0 to 255, not 300");
        let missing = reported("row = 1\n[[pins]]\npin = 3\n");
        assert!(
            missing.starts_with("a.toml, line 2") && missing.ends_with(": `kind` is missing"),
            "{missing}"
        );
        let unknown = reported("row = 1\n[[pins]]\npin = 3\nkinds = 3\n");
        assert_eq!(
            unknown,
            "a.toml, line 4: `kinds` is not a known key, did you mean `kind`? Known are `pin`, `kind`"
        );
        assert!(reported("row = = 1").starts_with("a.toml, line 1"));
    }
}
