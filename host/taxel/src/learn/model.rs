//! Encodes a linear model of touches for the board.

use crate::error::{Context, LearnError, Result};
use taxel_core::format::crc32;
use taxel_core::gesture::{LEADS, MAGIC, Model};

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

/// A linear classifier of touches from an age on. Score of a class: its offset, and for each feature its weight times
/// the feature's distance from the middle in deviations, at most 2.5. A model is fitted to score 1 for the class of a
/// touch and -1 for the others.
#[derive(Debug, Clone, Copy)]
pub struct LinearExpert<'a> {
    /// First age at which it decides, frames.
    pub from: usize,
    /// Middle of each feature.
    pub middle: &'a [f64],
    /// Deviation of each feature, above 0.
    pub deviation: &'a [f64],
    /// Weight of each feature, by class.
    pub weights: &'a [Vec<f64>],
    /// Offset of each class.
    pub offsets: &'a [f64],
    /// Share of right decisions at each lead, by first age; may be empty.
    pub confidence: &'a [(usize, [f64; LEADS])],
}

/// Encodes a model in the layout of [`Model`]. Error if it does not fit a board.
pub fn encode(experts: &[LinearExpert<'_>], head: ModelHead<'_>) -> Result<Vec<u8>> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend((head.notes.len() as u32).to_le_bytes());
    bytes.extend(head.notes.as_bytes());
    put(&mut bytes, [head.names.len(), experts.len(), head.pressed.into(), head.concludes.into()])?;
    for name in head.names {
        require!(name.len() <= 16, LearnError::Data, "class {name}: the name is longer than 16 bytes");
        let mut padded = [0; 16];
        padded[..name.len()].copy_from_slice(name.as_bytes());
        bytes.extend(padded);
    }
    experts.iter().try_for_each(|expert| add(&mut bytes, expert))?;
    let sum = crc32(&bytes);
    bytes.extend(sum.to_le_bytes());
    Model::read(&bytes).map_err(LearnError::Model).context("the model does not fit a board")?;
    Ok(bytes)
}

/// Appends numbers of 16 bits.
fn put<const N: usize>(bytes: &mut Vec<u8>, numbers: [usize; N]) -> Result<()> {
    for number in numbers {
        let Ok(number) = u16::try_from(number) else {
            fail!(LearnError::TooLarge, "{number} is above 65535")
        };
        bytes.extend(number.to_le_bytes());
    }
    Ok(())
}

/// Appends an expert.
fn add(bytes: &mut Vec<u8>, expert: &LinearExpert<'_>) -> Result<()> {
    let LinearExpert { from, middle, deviation, weights, offsets, confidence } = *expert;
    put(bytes, [from, middle.len(), confidence.len()])?;
    // A score of 1 is 2^18.
    offsets.iter().for_each(|offset| bytes.extend(((offset * 262_144.0).round() as i32).to_le_bytes()));
    for (index, (middle, deviation)) in middle.iter().zip(deviation).enumerate() {
        let scale = (65_536.0 / deviation).round().min(65_535.0) as u16;
        for number in [index as u16, middle.round() as u16, scale] {
            bytes.extend(number.to_le_bytes());
        }
        for weights in weights {
            let weight = weights.get(index).copied().unwrap_or(0.0);
            bytes.extend(((weight * 1024.0).round() as i16).to_le_bytes());
        }
    }
    for (age, row) in confidence {
        put(bytes, [*age])?;
        row.iter().for_each(|share| bytes.extend(((share * 32_768.0).round() as u16).to_le_bytes()));
    }
    Ok(())
}
