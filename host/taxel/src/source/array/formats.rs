//! Formats that come with the program.

use super::link::ArrayLink;

/// Formats that come with the program: name, description, and keys beyond those of every format.
const FORMATS: [(&str, &str, &[&str]); 9] = [
    ("numbers", include_str!("formats/numbers.toml"), &["rows", "columns"]),
    ("flexitac", include_str!("formats/flexitac.toml"), &["rows", "columns"]),
    ("vitac", include_str!("formats/vitac.toml"), &[]),
    ("wiresens", include_str!("formats/wiresens.toml"), &["rows", "columns", "nodes", "id"]),
    ("anyskin", include_str!("formats/anyskin.toml"), &["chips"]),
    ("reskin", include_str!("formats/anyskin.toml"), &["chips"]),
    ("eflesh", include_str!("formats/anyskin.toml"), &["chips"]),
    ("m0404s", include_str!("formats/m0404s.toml"), &[]),
    ("m1616", include_str!("formats/m1616.toml"), &[]),
];

/// Keys of every format.
const COMMON: [&str; 3] = ["range", "falling", "pitch_mm"];

/// Names of the formats.
pub const NAMES: [&str; FORMATS.len()] = {
    let mut names = [""; FORMATS.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = FORMATS[at].0;
        at += 1;
    }
    names
};

/// Description of a format that comes with the program.
pub fn text(format: &str) -> Option<&'static str> {
    FORMATS.iter().find(|(name, ..)| *name == format).map(|(_, text, _)| *text)
}

/// Returns the keys of a format that comes with the program or is described by a file.
pub fn keys(format: &str, link: &ArrayLink) -> Vec<&'static str> {
    let own = FORMATS.iter().find(|(name, ..)| *name == format).map_or(&[][..], |(.., keys)| *keys);
    let rate = matches!(link, ArrayLink::File(_)).then_some("rate");
    own.iter().copied().chain(COMMON).chain(rate).collect()
}
