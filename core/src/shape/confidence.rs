//! Confidence of a vote: the accuracy of similar votes.

use crate::format::{Invalid, Q15};
use serde::{Deserialize, Serialize};

/// Number of steps of the share, and of the distance.
pub const STEPS: usize = 4;

/// A table of accuracies, measured by the trainer on examples that were left out of training.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConfidenceTable {
    /// Lower limits of the steps of the share of votes, from the second step on; ascending.
    pub shares: [u16; STEPS - 1],
    /// Lower limits of the steps of the distance to the nearest prototype, from the second step on;
    /// ascending.
    pub distances: [u16; STEPS - 1],
    /// Accuracy, Q15, by step of the share and step of the distance.
    pub right: [[u16; STEPS]; STEPS],
}

impl ConfidenceTable {
    /// Checks a table from outside. Error if an accuracy exceeds 1.0.
    pub fn check(&self) -> Result<(), Invalid> {
        if self.right.iter().flatten().any(|right| *right > 32_768) {
            return Err(Invalid { parameter: "shapes.sureness", must: "must be at most 32768 (1.0)" });
        }
        Ok(())
    }

    /// Step of a share of votes and step of a distance.
    pub fn cell(&self, share: Q15, distance: u32) -> (usize, usize) {
        let row = self.shares.iter().filter(|from| share.0 >= i32::from(**from)).count();
        (row, self.distances.iter().filter(|from| distance >= u32::from(**from)).count())
    }

    /// Confidence for a share of votes and a distance.
    pub fn of(&self, share: Q15, distance: u32) -> Q15 {
        let (row, column) = self.cell(share, distance);
        let right = self.right.get(row).and_then(|row| row.get(column));
        Q15(right.copied().unwrap_or(0).into())
    }
}
