//! Pressure on the taxels on one day, and the joints' angles.

use crate::error::{LearnError, Result};

/// Pressure on every taxel, frame by frame, while joints moved and nothing touched the garment.
#[derive(Debug, Clone, Default)]
pub struct FoldSweep {
    joints: Vec<String>,
    angles: Vec<f32>,
    /// By taxel, then by frame, which is how it is read.
    felt: Vec<Vec<u16>>,
}

impl FoldSweep {
    /// No frame yet, of these joints and so many taxels.
    pub fn new(joints: Vec<String>, taxels: usize) -> FoldSweep {
        FoldSweep { joints, angles: Vec::new(), felt: vec![Vec::new(); taxels] }
    }

    /// Adds a frame: the joints' angles (degrees) as the board knew them, and the pressure of every taxel
    /// (counts), as conditioned by a board that knows of no folds.
    pub fn push(&mut self, degrees: &[f32], felt: &[u16]) -> Result<()> {
        require!(
            degrees.len() == self.joints.len() && felt.len() == self.felt.len(),
            LearnError::Data,
            "frame {}: {} angles and {} taxels instead of {} and {}",
            self.frames(),
            degrees.len(),
            felt.len(),
            self.joints.len(),
            self.felt.len()
        );
        require!(
            degrees.iter().all(|angle| angle.is_finite() && angle.abs() <= 180.0),
            LearnError::Data,
            "frame {}: angles must be -180 to 180 degrees",
            self.frames()
        );
        self.angles.extend_from_slice(degrees);
        self.felt.iter_mut().zip(felt).for_each(|(all, felt)| all.push(*felt));
        Ok(())
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.angles.len() / self.joints.len().max(1)
    }

    /// Number of taxels.
    pub fn taxels(&self) -> usize {
        self.felt.len()
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

    /// Returns the pressure on a taxel, counts, frame by frame.
    pub(super) fn felt(&self, taxel: usize) -> impl Iterator<Item = u16> {
        self.felt[taxel].iter().copied()
    }
}
