//! Map files by path or by the name of a shipped one, and the words of the command line that speak of concepts.

use super::decimal::Decimal;
use super::map::MapFile;
use super::wrong;
use crate::fault::Fault;
use crate::output::Output;
use crate::words;
use anyhow::{Context, Result, anyhow, bail};
use std::borrow::Cow;
use std::path::Path;

/// The maps that ship.
pub const SHIPPED: [(&str, &str); 2] =
    [("tactile", include_str!("../../maps/tactile.toml")), ("shape", include_str!("../../maps/shape.toml"))];

/// Reads a map: a TOML file, or a shipped one by its name. Every error is a sentence with the file, the place
/// and the value.
pub fn map(name_or_path: &str) -> Result<MapFile> {
    parse(&text(name_or_path)?, name_or_path)
}

/// The text of a map: a shipped one by its name, else a file.
pub fn text(name_or_path: &str) -> Result<Cow<'static, str>> {
    let names = SHIPPED.map(|(name, _)| name);
    if let Some((_, text)) = SHIPPED.iter().find(|(name, _)| *name == name_or_path) {
        return Ok(Cow::Borrowed(text));
    }
    // What is no path can only be a name.
    if !name_or_path.contains(['.', '/', '\\']) && !Path::new(name_or_path).exists() {
        let known = words::unknown("map", name_or_path, names);
        bail!(Fault::usage(format!("{known}, or give a .toml file")));
    }
    crate::verbose::reads(name_or_path);
    let read = std::fs::read_to_string(name_or_path).map(Cow::Owned);
    read.with_context(|| {
        format!("{name_or_path}: cannot be read, and the shipped maps are {}", names.join(", "))
    })
}

/// Reads the text of a map from `place`.
pub fn parse(text: &str, place: &str) -> Result<MapFile> {
    let map: MapFile = toml::from_str(text).map_err(|error| anyhow!(words::toml(&error, text, place)))?;
    map.check_numbers().map_err(|error| wrong::located(error, text, place))?;
    Ok(map)
}

/// Writes a map.
pub fn save(map: &MapFile, output: Output) -> Result<()> {
    output.write(toml::to_string(map).context("the map cannot be written")?.as_bytes())
}

/// The name of a map that is written there: that of the file.
pub fn name(output: &Output) -> Result<String> {
    if output.is_standard() {
        return Ok("map".into());
    }
    let stem = output.name().file_stem().and_then(|stem| stem.to_str());
    Ok(stem.context("--output names no file")?.into())
}

/// `NAME=VALUE` with a value in -1 ..= 1.
pub fn assignment(text: &str) -> Result<(String, Decimal), String> {
    let wrong = || "expected NAME=VALUE with a value in -1 ..= 1".to_string();
    let (name, value) = text.split_once('=').ok_or_else(wrong)?;
    let value = Decimal::parse(value.trim()).filter(|value| value.is_fraction()).ok_or_else(wrong)?;
    Ok((name.trim().into(), value))
}
