//! A sensor by the name of its format, with the keys of its source.

use super::description::ArrayDescription;
use super::form::FrameForm;
use super::link::ArrayLink;
use super::spec::ArraySpec;
use crate::error::{Result, UsageError};

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

/// Returns the keys of a format that comes with the program or is described by a file.
pub fn keys(format: &str, link: &ArrayLink) -> Vec<&'static str> {
    let own = FORMATS.iter().find(|(name, ..)| *name == format).map_or(&[][..], |(.., keys)| *keys);
    let rate = matches!(link, ArrayLink::File(_)).then_some("rate");
    own.iter().copied().chain(COMMON).chain(rate).collect()
}

/// The description of a source's format, with its keys.
pub fn described(spec: &ArraySpec) -> Result<ArrayDescription> {
    let known = FORMATS.iter().find(|(name, ..)| *name == spec.format);
    let mut description = match known {
        Some((name, text, _)) => ArrayDescription::parse(text, name)?,
        None => ArrayDescription::read(&spec.format)?,
    };
    for (key, value) in &spec.keys {
        if let Err(why) = set(&mut description, key, value) {
            fail!(UsageError::Argument, "{spec}: `{key}`: {why}");
        }
    }
    if spec.format == "numbers" {
        for key in ["rows", "columns"] {
            let given = spec.keys.iter().any(|(known, _)| known == key);
            require!(given, UsageError::Argument, "{spec}: `{key}` is missing: add {key}=N");
        }
    }
    if description.range.is_none() {
        fail!(
            UsageError::Argument,
            "{spec}: this format states no range: add range=LOW..HIGH, the values of no pressure and of the greatest"
        );
    }
    // Neither a network nor its packets need a trailer.
    if let (FrameForm::Wiresens { trailer, .. }, ArrayLink::Tcp(_) | ArrayLink::Listen(_)) =
        (&mut description.frame, &spec.link)
    {
        *trailer = false;
    }
    if let Err((key, why)) = description.check() {
        fail!(UsageError::Argument, "{spec}: `{key}`: {why}");
    }
    Ok(description)
}

/// Sets a key. Error: why its value is wrong.
fn set(description: &mut ArrayDescription, key: &str, value: &str) -> std::result::Result<(), String> {
    let whole =
        || value.parse::<u16>().map_err(|_| format!("\"{value}\" must be a whole number of 0 to 65535"));
    match (key, &mut description.frame) {
        ("rows" | "chips", _) => description.rows = whole()?,
        ("columns", _) => description.columns = whole()?,
        ("range", _) => {
            description.range = Some(pair(value, "..").ok_or("it must be LOW..HIGH, such as 0..1023")?)
        }
        ("falling", _) => {
            description.falling = value.parse().map_err(|_| format!("\"{value}\" must be true or false"))?;
        }
        ("pitch_mm", _) => {
            let both = pair(value, "x").or_else(|| value.parse().ok().map(|mm| [mm; 2]));
            let both = both.ok_or("it must be a number, or two as in 5x8: distance of columns, of rows")?;
            description.pitch_um = Some(both.map(|mm| (mm * 1000.0) as u32));
        }
        ("nodes", FrameForm::Wiresens { nodes, .. }) => *nodes = whole()?,
        ("id", FrameForm::Wiresens { id, .. }) => {
            *id = Some(
                value.parse().map_err(|_| format!("\"{value}\" must be a whole number of -128 to 127"))?,
            );
        }
        _ => {}
    }
    Ok(())
}

/// Two numbers.
fn pair(text: &str, between: &str) -> Option<[f64; 2]> {
    let (low, high) = text.split_once(between)?;
    Some([low.parse().ok()?, high.parse().ok()?])
}
