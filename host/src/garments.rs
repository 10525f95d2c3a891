//! Garments as files.

use crate::output::Output;
use anyhow::{Context, Result};
use taxel_core::garment::Garment;

/// Garments that come with the program whose rows and columns are joined by the cloth alone, and read through a resistor: what
/// is pressed elsewhere in a block leads current past the taxel that is read. In the others an amplifier holds what is read at
/// one voltage.
const PASSIVE: [&str; 1] = ["block-4x16"];

/// Whether a garment's blocks are passive matrices, as one that keeps the name of the one it was made of.
pub fn is_passive(garment: &Garment) -> bool {
    PASSIVE.contains(&garment.name.as_str())
}

/// A garment as TOML, with a comment of some lines above it.
pub fn text(garment: &Garment, comment: &str) -> Result<String> {
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    Ok(comment + &toml::to_string(garment).context("the garment cannot be written as TOML")?)
}

/// Writes a garment's file, or prints it where there is none.
pub fn write(garment: &Garment, comment: &str, output: Option<Output>) -> Result<()> {
    let text = text(garment, comment)?;
    let Some(output) = output else {
        print!("\n{text}");
        return Ok(());
    };
    output.write(text.as_bytes())
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
    fn a_file_is_read_as_it_was_written() {
        for name in Garment::PRESETS {
            let garment = Garment::preset(name).unwrap();
            let text = text(&garment, "one\ntwo").unwrap();
            assert!(text.starts_with("# one\n# two\nname = "), "{text}");
            assert_eq!(toml::from_str::<Garment>(&text).unwrap(), garment);
        }
    }
}
