//! State of the baseline's tare and drift.

use super::consensus::Consensus;
use super::progress::Progress;
use super::turn::RowRotation;

/// Tare and drift of the baseline.
#[derive(Debug, Clone)]
pub(crate) struct Tracking {
    pub progress: Progress,
    pub consensus: Consensus,
    pub turn: RowRotation,
}

impl Tracking {
    /// Not tared; drift begins with the first row.
    pub const fn new() -> Self {
        Tracking { progress: Progress::new(), consensus: Consensus::new(), turn: RowRotation::new() }
    }

    /// Starts over for a garment; the total drift of the panels goes on.
    pub fn reset(&mut self) {
        self.progress = Progress::new();
        self.consensus.forget();
        self.turn = RowRotation::new();
    }
}
