//! Encodes a trained model for the board.

use super::experts::Trained;
use anyhow::{Context, Result, ensure};
use taxel_core::format::crc32;
use taxel_core::gesture::{MAGIC, Model};

/// Parts of a model besides its experts.
#[derive(Debug, Clone, Copy)]
pub struct ModelHead<'a> {
    /// Names of the classes.
    pub names: &'a [String],
    /// Value above which a cell counts as touched.
    pub pressed: u16,
    /// True if the last expert decides at the end of a touch, whatever its age.
    pub concludes: bool,
    /// Provenance as JSON.
    pub notes: &'a str,
}

/// Encodes a model in the layout of [`Model`].
pub fn export(experts: &[Trained], head: ModelHead<'_>) -> Result<Vec<u8>> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(u32::try_from(head.notes.len())?.to_le_bytes());
    bytes.extend(head.notes.as_bytes());
    let numbers =
        [head.names.len().try_into()?, experts.len().try_into()?, head.pressed, head.concludes.into()];
    numbers.into_iter().for_each(|number: u16| bytes.extend(number.to_le_bytes()));
    for name in head.names {
        ensure!(name.len() <= 16, "class {name}: the name is longer than 16 bytes");
        let mut padded = [0; 16];
        padded[..name.len()].copy_from_slice(name.as_bytes());
        bytes.extend(padded);
    }
    experts.iter().try_for_each(|expert| add(&mut bytes, expert))?;
    let sum = crc32(&bytes);
    bytes.extend(sum.to_le_bytes());
    Model::read(&bytes).context("the trained model does not fit a board")?;
    Ok(bytes)
}

/// Appends an expert.
fn add(bytes: &mut Vec<u8>, expert: &Trained) -> Result<()> {
    let Trained { from, ridge, rows } = expert;
    let count = ridge.middle.len();
    for number in [*from, count, rows.len()] {
        bytes.extend(u16::try_from(number)?.to_le_bytes());
    }
    // A score of 1 is 2^18.
    ridge.offsets.iter().for_each(|offset| bytes.extend(((offset * 262_144.0).round() as i32).to_le_bytes()));
    for index in 0..count {
        let scale = (65_536.0 / ridge.deviation[index]).round().min(65_535.0) as u16;
        for number in [index as u16, ridge.middle[index].round() as u16, scale] {
            bytes.extend(number.to_le_bytes());
        }
        for weights in &ridge.weights {
            bytes.extend(((weights[index] * 1024.0).round() as i16).to_le_bytes());
        }
    }
    for (age, row) in rows {
        bytes.extend(u16::try_from(*age)?.to_le_bytes());
        row.iter().for_each(|share| bytes.extend(((share * 32_768.0).round() as u16).to_le_bytes()));
    }
    Ok(())
}
