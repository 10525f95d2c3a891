//! What the taxels felt on one day, and the joints' angles.

use crate::error::{LearnError, Result};

/// What every taxel felt, frame by frame, while joints moved and nothing touched the garment.
#[derive(Debug, Clone, Default)]
pub struct Sweep {
    joints: Vec<String>,
    taxels: usize,
    angles: Vec<f32>,
    felt: Vec<u16>,
}

impl Sweep {
    /// No frame yet, of these joints and so many taxels.
    pub fn new(joints: Vec<String>, taxels: usize) -> Sweep {
        Sweep { joints, taxels, ..Sweep::default() }
    }

    /// Adds a frame: the joints' angles (degrees) as the board knew them, and the pressure of every taxel
    /// (counts), as conditioned by a board that knows of no folds.
    pub fn push(&mut self, degrees: &[f32], felt: &[u16]) -> Result<()> {
        require!(
            degrees.len() == self.joints.len() && felt.len() == self.taxels,
            LearnError::Data,
            "frame {}: {} angles and {} taxels instead of {} and {}",
            self.frames(),
            degrees.len(),
            felt.len(),
            self.joints.len(),
            self.taxels
        );
        require!(
            degrees.iter().all(|angle| angle.is_finite() && angle.abs() <= 180.0),
            LearnError::Data,
            "frame {}: angles must be -180 to 180 degrees",
            self.frames()
        );
        self.angles.extend_from_slice(degrees);
        self.felt.extend_from_slice(felt);
        Ok(())
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.angles.len() / self.joints.len().max(1)
    }

    /// Number of taxels.
    pub fn taxels(&self) -> usize {
        self.taxels
    }

    /// Names of the joints.
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Angles of a joint, degrees, frame by frame; none if it did not take part.
    pub(super) fn angles(&self, joint: &str) -> Option<impl Iterator<Item = f32>> {
        let at = self.joints.iter().position(|other| other == joint)?;
        Some(self.angles.chunks(self.joints.len()).map(move |frame| frame[at]))
    }

    /// What a taxel felt, counts, frame by frame.
    pub(super) fn felt(&self, taxel: usize) -> impl Iterator<Item = u16> {
        self.felt.chunks(self.taxels.max(1)).map(move |frame| frame[taxel])
    }
}
