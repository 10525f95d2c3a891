//! A trained model as the bytes that a board reads.

use super::ridge::Ridge;
use anyhow::{Context, Result, ensure};
use taxel_core::gesture::{MAGIC, Model, checksum};

/// What a model has beside its planes.
#[derive(Debug, Clone, Copy)]
pub struct Head<'a> {
    /// Names of the classes.
    pub names: &'a [String],
    /// A cell above this counts as touched.
    pub pressed: u16,
    /// The provenance as JSON.
    pub notes: &'a str,
}

/// The bytes of a model; the layout is that of [`Model`].
pub fn export(ridge: &Ridge, head: Head<'_>) -> Result<Vec<u8>> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(u32::try_from(head.notes.len())?.to_le_bytes());
    bytes.extend(head.notes.as_bytes());
    let count = ridge.middle.len();
    for number in [head.names.len().try_into()?, count.try_into()?, head.pressed] {
        bytes.extend(u16::to_le_bytes(number));
    }
    for name in head.names {
        ensure!(name.len() <= 16, "class {name}: the name is longer than 16 bytes");
        let mut padded = [0; 16];
        padded[..name.len()].copy_from_slice(name.as_bytes());
        bytes.extend(padded);
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
    let sum = checksum(&bytes);
    bytes.extend(sum.to_le_bytes());
    Model::read(&bytes).context("the trained model does not fit a board")?;
    Ok(bytes)
}
