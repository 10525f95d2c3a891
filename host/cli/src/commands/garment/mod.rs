//! Commands about a garment: its files, and from raw codes its wiring, forces and settling time.

pub mod calibrate;
pub mod config;
pub mod setup;

use anyhow::Result;
use taxel::files::garments::text;
use taxel::files::output::Output;
use taxel_core::garment::Garment;

/// Writes a garment's file. Prints the garment if there is no file, or if it cannot be written, so that a
/// garment found by touch is not lost.
pub fn write(garment: &Garment, comment: &str, output: Option<Output>) -> Result<()> {
    let text = text(garment, comment)?;
    let Some(output) = output else {
        print!("\n{text}");
        return Ok(());
    };
    Ok(output.write(text.as_bytes()).inspect_err(|_| print!("\n{text}"))?)
}
