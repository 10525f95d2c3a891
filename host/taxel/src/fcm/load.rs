//! Reads map files by path or shipped maps by name, and parses concepts of the command line.

use super::decimal::Decimal;
use super::map::MapFile;
use super::wrong;
use crate::error::{Context, FileError, MapFileError, Result, UsageError};
use crate::files::input;
use crate::files::output::Output;
use crate::text::words;
use std::borrow::Cow;
use std::path::Path;

/// The shipped maps.
pub const SHIPPED: [(&str, &str); 4] = [
    ("tactile", include_str!("../../maps/tactile.toml")),
    ("shape", include_str!("../../maps/shape.toml")),
    ("robot", include_str!("../../maps/robot.toml")),
    ("probe", include_str!("../../maps/probe.toml")),
];

/// Reads a map: a TOML file, or a shipped one by name. Errors are sentences with file, place and value.
pub fn map(name_or_path: &str) -> Result<MapFile> {
    parse(&text(name_or_path)?, name_or_path)
}

/// Text of a map: a shipped one by name, else a file.
pub fn text(name_or_path: &str) -> Result<Cow<'static, str>> {
    let names = SHIPPED.map(|(name, _)| name);
    if let Some((_, text)) = SHIPPED.iter().find(|(name, _)| *name == name_or_path) {
        return Ok(Cow::Borrowed(text));
    }
    // A text that cannot be a path is a name.
    if !name_or_path.contains(['.', '/', '\\']) && !Path::new(name_or_path).exists() {
        let known = words::unknown("map", name_or_path, names);
        fail!(UsageError::Unknown, "{known}, or give a .toml file");
    }
    input::text(name_or_path).map(Cow::Owned).with_context(|| {
        format!("{name_or_path}: cannot be read, and the shipped maps are {}", names.join(", "))
    })
}

/// Parses the text of a map from `place`.
pub fn parse(text: &str, place: &str) -> Result<MapFile> {
    let map: MapFile =
        toml::from_str(text).map_err(|error| MapFileError::Malformed(words::toml(&error, text, place)))?;
    map.check_numbers().map_err(|error| wrong::located(error, text, place))?;
    Ok(map)
}

/// Writes a map.
pub fn save(map: &MapFile, output: Output) -> Result<()> {
    output.write(toml::to_string(map).context("the map cannot be written")?.as_bytes())
}

/// Name of a map written there: that of the file.
pub fn name(output: &Output) -> Result<String> {
    if output.is_standard() {
        return Ok("map".into());
    }
    let stem = output.name().file_stem().and_then(|stem| stem.to_str());
    Ok(stem.ok_or_else(|| error!(FileError::Output, "--output names no file"))?.into())
}

/// Parses `NAME=VALUE` with a value in -1 ..= 1.
pub fn assignment(text: &str) -> Result<(String, Decimal), String> {
    let wrong = || "expected NAME=VALUE with a value in -1 ..= 1".to_string();
    let (name, value) = text.split_once('=').ok_or_else(wrong)?;
    let value = Decimal::parse(value.trim()).filter(|value| value.is_fraction()).ok_or_else(wrong)?;
    Ok((name.trim().into(), value))
}
