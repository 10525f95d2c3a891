//! Garments as files.

use anyhow::{Context, Result};
use std::path::Path;
use taxel_core::garment::Garment;

/// A garment as TOML, with a comment of some lines above it.
pub fn text(garment: &Garment, comment: &str) -> Result<String> {
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    Ok(comment + &toml::to_string(garment).context("the garment cannot be written as TOML")?)
}

/// Writes a garment's file, or prints it where there is none.
pub fn write(garment: &Garment, comment: &str, file: Option<&Path>) -> Result<()> {
    let text = text(garment, comment)?;
    let Some(file) = file else {
        print!("\n{text}");
        return Ok(());
    };
    std::fs::write(file, text).with_context(|| format!("{} cannot be written", file.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

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
