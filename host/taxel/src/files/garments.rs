//! Garment files: panels, blocks and wiring, or a grid without wiring.

mod grid;
mod key;

use self::grid::GridFile;
use super::input;
use crate::error::{Context, Error, Result, SettingError, UsageError};
use crate::text::{toml_key, words};
use std::fmt::Display;
use std::path::Path;
use taxel_core::garment::{Garment, GarmentError, Pins};

/// Names and texts of the presets.
const PRESETS: [(&str, &str); 3] = [
    ("reference", include_str!("../../garments/reference.toml")),
    ("mat-64x32", include_str!("../../garments/mat-64x32.toml")),
    ("block-4x16", include_str!("../../garments/block-4x16.toml")),
];

/// A garment's file and its contents.
#[derive(Debug, Clone)]
pub struct Read {
    /// Path of the file, or name of the preset.
    pub name: String,
    /// Text of the file, with its comments.
    pub text: String,
    /// The garment, unchecked.
    pub garment: Garment,
}

impl Read {
    /// Error about the garment, with the line of the key to change.
    pub fn error(&self, error: &GarmentError) -> Error {
        self.error_at(&key::key(error, &self.garment), error)
    }

    /// Error about one of its keys, with its line.
    pub fn error_at(&self, key: &str, error: impl Display) -> Error {
        let key = if self.is_grid() { grid::key_in(key) } else { key.into() };
        toml_key::error(&self.name, &self.text, &key, error).into()
    }

    /// Pins to check the wiring against: any, without a converter for a grid.
    pub fn pins(&self) -> Pins {
        if self.is_grid() { Pins { inputs: 0, ..Pins::ANY } } else { Pins::ANY }
    }

    /// True if the file has a grid in place of wiring.
    pub fn is_grid(&self) -> bool {
        GridFile::is_one(&self.text)
    }
}

/// Reads a preset or a garment's TOML file. Errors name the file, the line and the key.
pub fn read(name_or_path: &str) -> Result<Read> {
    let name = name_or_path.to_string();
    if let Some((_, text)) = PRESETS.iter().find(|(preset, _)| *preset == name) {
        return Ok(Read { garment: toml::from_str(text)?, text: text.to_string(), name });
    }
    if !name.ends_with(".toml") && !Path::new(&name).is_file() {
        let known = PRESETS.map(|(preset, _)| preset);
        let unknown = words::unknown("garment", &name, known);
        fail!(UsageError::Unknown, "{unknown}, or give a .toml file");
    }
    let text = input::text(&name).with_context(|| format!("cannot read {name}"))?;
    let garment = parse(&text, &name)?;
    Ok(Read { name, text, garment })
}

/// Reads the text of a garment's file; errors call it by this name.
pub fn parse(text: &str, name: &str) -> Result<Garment> {
    if GridFile::is_one(text) {
        return Ok(GridFile::read(text, name)?);
    }
    let garment =
        toml::from_str(text).map_err(|error| SettingError::Malformed(words::toml(&error, text, name)))?;
    Ok(garment)
}

/// Loads a preset or a garment's TOML file, see [`read`].
pub fn load(name_or_path: &str) -> Result<Garment> {
    Ok(read(name_or_path)?.garment)
}

/// Presets with passive matrices: only the fabric joins rows and columns, which are read through a resistor,
/// so that pressure elsewhere in a block leads current past the taxel that is read. The other presets have an
/// amplifier that holds the read line at one voltage.
const PASSIVE: [&str; 1] = ["block-4x16"];

/// True if a garment's blocks are passive matrices; it is recognised by the name of its preset.
pub fn is_passive(garment: &Garment) -> bool {
    PASSIVE.contains(&garment.name.as_str())
}

/// Encodes a garment as TOML, below a comment of one or more lines.
pub fn text(garment: &Garment, comment: &str) -> Result<String> {
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    let text = match GridFile::of(garment) {
        Some(grid) => toml::to_string(&grid),
        None => toml::to_string(garment),
    };
    Ok(comment + &text.context("the garment cannot be written as TOML")?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_to_be_passive_comes_with_the_program() {
        assert!(PASSIVE.iter().all(|name| Garment::PRESETS.contains(name)));
        assert!(is_passive(&Garment::block()) && !is_passive(&Garment::reference()));
    }

    #[test]
    fn the_files_of_presets_are_those_of_the_core() {
        assert_eq!(PRESETS.map(|(name, _)| name), Garment::PRESETS);
        for name in Garment::PRESETS {
            let Read { text, garment, .. } = read(name).unwrap();
            assert_eq!(Some(garment), Garment::preset(name));
            assert!(text.starts_with("# ") && text.lines().filter(|line| line.contains('#')).count() > 8);
        }
    }

    #[test]
    fn a_garment_that_is_not_known_is_reported_with_the_nearest() {
        let why = read("refrence").unwrap_err().to_string();
        assert!(
            why.starts_with("there is no garment \"refrence\": did you mean \"reference\"? Known are"),
            "{why}"
        );
    }

    #[test]
    fn a_file_is_read_as_it_was_written() {
        for name in Garment::PRESETS {
            let garment = Garment::preset(name).unwrap();
            let text = text(&garment, "one\ntwo").unwrap();
            assert!(text.starts_with("# one\n# two\nname = "), "{text}");
            assert_eq!(toml::from_str::<Garment>(&text).unwrap(), garment);
        }
    }
}
