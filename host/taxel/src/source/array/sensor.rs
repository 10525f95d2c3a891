//! A sensor by the name of its format, with the keys of its source.

use super::description::ArrayDescription;
use super::form::FrameForm;
use super::formats;
use super::link::ArrayLink;
use super::spec::ArraySpec;
use crate::error::{Result, UsageError};

/// The description of a source's format, with its keys.
pub fn described(spec: &ArraySpec) -> Result<ArrayDescription> {
    let mut description = match formats::text(&spec.format) {
        Some(text) => ArrayDescription::parse(text, &spec.format)?,
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
