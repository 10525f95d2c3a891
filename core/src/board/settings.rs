//! Settings that survive a restart.

use crate::capacity::TAXELS;
use crate::condition::Certificate;
use crate::garment::Garment;
use crate::health::FaultyTaxel;
use crate::scene::Scene;
use crate::wire::write;
use core::fmt;
use serde::Serialize;

/// Longest part of the settings, bytes: two for each of [`TAXELS`] taxels.
pub const PART_BYTES: usize = 2 * TAXELS;

/// A part of the settings, in the order in which they are restored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Part {
    /// The [`Garment`], postcard.
    Garment = 0,
    /// The [`Scene`] with its map, postcard.
    Scene = 1,
    /// Gains by taxel number, Q4.12, two bytes each, little-endian.
    Gain = 2,
    /// Baseline codes by taxel number, two bytes each, little-endian; absent without a tare.
    Baseline = 3,
    /// The [`Certificate`] of the gains, postcard; absent without one.
    Calibration = 4,
}

impl Part {
    /// All parts.
    pub const ALL: [Part; 5] = [Part::Garment, Part::Scene, Part::Gain, Part::Baseline, Part::Calibration];
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Part::Garment => "garment",
            Part::Scene => "scene",
            Part::Gain => "gain",
            Part::Baseline => "baseline",
            Part::Calibration => "calibration",
        })
    }
}

/// Result of a successful save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Saved {
    /// The flash was written.
    Written,
    /// The flash held these settings already and was not written.
    Unchanged,
}

/// Error: a part has more than [`PART_BYTES`] bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLong;

/// Settings that survive a restart.
#[derive(Debug, Clone, Copy)]
pub struct Settings<'a> {
    /// The garment.
    pub garment: &'a Garment,
    /// The scene.
    pub scene: &'a Scene,
    /// Gains by taxel number, Q4.12.
    pub gain: &'a [u16],
    /// Faulty taxels; their gains replace those of `gain`.
    pub faulty: &'a [FaultyTaxel],
    /// Baseline codes by taxel number; none without a tare.
    pub baseline: Option<&'a [u16]>,
    /// Calibration from which the gains come.
    pub calibration: Option<&'a Certificate>,
    /// Saves that the flash allows soon after this one; a reset grants no more.
    pub saves: u8,
}

impl Settings<'_> {
    /// Writes the bytes of a part into `buffer`; returns none if there is no such part.
    pub fn write<'b>(&self, part: Part, buffer: &'b mut [u8]) -> Result<Option<&'b [u8]>, TooLong> {
        match part {
            Part::Garment => text(self.garment, buffer).map(Some),
            Part::Scene => text(self.scene, buffer).map(Some),
            Part::Gain => {
                let gains = |taxel| {
                    self.faulty
                        .iter()
                        .find(|faulty| usize::from(faulty.taxel) == taxel)
                        .map(|faulty| faulty.gain)
                };
                numbers(self.gain, gains, buffer).map(Some)
            }
            Part::Baseline => self.baseline.map(|baseline| numbers(baseline, |_| None, buffer)).transpose(),
            Part::Calibration => self.calibration.map(|certificate| text(certificate, buffer)).transpose(),
        }
    }
}

fn text<'b, T: Serialize>(value: &T, buffer: &'b mut [u8]) -> Result<&'b [u8], TooLong> {
    let bytes = write(value, buffer).map_err(|_| TooLong)?;
    buffer.get(..bytes).ok_or(TooLong)
}

/// Writes values by taxel number, replaced by `other` where it returns one.
fn numbers<'b>(
    values: &[u16],
    other: impl Fn(usize) -> Option<u16>,
    buffer: &'b mut [u8],
) -> Result<&'b [u8], TooLong> {
    let buffer = buffer.get_mut(..2 * values.len()).ok_or(TooLong)?;
    for (taxel, (to, value)) in buffer.as_chunks_mut().0.iter_mut().zip(values).enumerate() {
        *to = other(taxel).unwrap_or(*value).to_le_bytes();
    }
    Ok(buffer)
}
