//! What the stage remembers: the calibration of every taxel and the last image.

use super::consensus::Consensus;
use super::points::Points;
use super::progress::{Progress, Tare};
use super::rows::Rows;
use super::slices::row_mut;
use super::terms::Terms;
use super::turn::Turn;
use crate::format::Code;
use crate::garment::Layout;

/// A gain of 1.0 in Q4.12.
pub const UNITY: u16 = 4096;

/// Baseline, gain and image of every taxel.
#[derive(Debug, Clone)]
pub struct ConditionState<const TAXELS: usize> {
    /// Code at rest. While a tare runs: the low halves of the sums.
    pub(super) baseline: [u16; TAXELS],
    /// Q4.12; 0 for absent taxels.
    pub(super) gain: [u16; TAXELS],
    /// The last code of each taxel that is quiet.
    pub(super) limit: [u16; TAXELS],
    /// What the limits were made for; none: they are not valid.
    pub(super) limits_for: Option<Terms>,
    /// Every gain is known to be 1, or 0, with which no taxel is beyond its limit.
    pub(super) plain: bool,
    /// Before the filter. While a tare runs: the high halves of the sums.
    pub(super) calibrated: [u16; TAXELS],
    /// After the filter.
    pub(super) filtered: [u16; TAXELS],
    /// Where one of the images may hold something.
    pub(super) rows: Rows,
    /// Panels that may hold something.
    pub(super) active: u8,
    /// Taxels that stand out of their neighbours.
    pub(super) points: Points,
    pub(super) tracking: Progress,
    pub(super) consensus: Consensus,
    pub(super) turn: Turn,
}

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// For no garment: every gain is 0. To be followed by [`ConditionState::reset`].
    pub const fn new() -> Self {
        ConditionState {
            baseline: [0; TAXELS],
            gain: [0; TAXELS],
            limit: [0; TAXELS],
            limits_for: None,
            plain: false,
            calibrated: [0; TAXELS],
            filtered: [0; TAXELS],
            rows: Rows::NONE,
            active: 0,
            points: Points::new(),
            tracking: Progress::new(),
            consensus: Consensus::new(),
            turn: Turn::new(),
        }
    }

    /// Starts afresh on a garment: every baseline is `rest` (0, or the full scale of a garment on which
    /// pressure lowers the code), every gain 1.0, and 0 where a taxel is absent. A tare under way is
    /// forgotten.
    pub fn reset(&mut self, layout: &Layout, rest: Code) {
        self.baseline.fill(rest.0);
        self.gain.fill(0);
        for (panel, area) in layout.areas().iter().enumerate() {
            for row in 0..area.rows {
                for (column, gain) in (0..area.columns).zip(row_mut(&mut self.gain, area, row)) {
                    *gain = if layout.is_absent(panel as u8, row, column) { 0 } else { UNITY };
                }
            }
        }
        self.limits_for = None;
        self.calibrated.fill(0);
        self.filtered.fill(0);
        (self.rows, self.active) = (Rows::NONE, 0);
        self.points.forget();
        self.tracking = Progress::new();
        self.consensus.forget();
        self.turn = Turn::new();
    }

    /// Sets the gain of a taxel, Q4.12 (4096 is 1.0); 0 silences it, as a dead taxel. `false` if there is no
    /// such taxel.
    pub fn set_gain(&mut self, taxel: usize, gain: u16) -> bool {
        let Some(held) = self.gain.get_mut(taxel) else { return false };
        *held = gain;
        self.set_limit(taxel);
        true
    }

    /// Restores the baseline of a taxel, as a tare would have set it; all of it follows drift from then on.
    /// `false` if there is no such taxel or a tare is under way.
    pub fn set_baseline(&mut self, taxel: usize, rest: Code) -> bool {
        if matches!(self.tracking.tare(), Tare::Running { .. }) {
            return false;
        }
        let Some(held) = self.baseline.get_mut(taxel) else { return false };
        *held = rest.0;
        self.tracking.mark_tared();
        self.consensus.forget();
        self.set_limit(taxel);
        true
    }

    /// Code at rest by taxel number; none while a tare runs.
    pub fn baseline(&self) -> Option<&[u16]> {
        (!matches!(self.tracking.tare(), Tare::Running { .. })).then_some(&self.baseline)
    }

    /// What a panel has drifted since the start, as its witnesses agree: counts modulo 2^32, of which only
    /// differences mean something.
    pub fn drifted(&self, panel: u8) -> i32 {
        self.consensus.drifted(panel)
    }

    /// Gains by taxel number, Q4.12.
    pub fn gain(&self) -> &[u16] {
        &self.gain
    }

    /// Takes the mean code of the next `frames` frames (at least 1) as the baseline; a tare under way starts
    /// again. The panels that the first of those frames works on are tared, the others keep theirs. The old
    /// baseline is given up at once. It is the caller's part not to tare under load, and to say so where
    /// contacts are present.
    pub fn tare(&mut self, frames: u16) {
        self.tracking.request(frames.max(1));
    }

    /// How far the tare is.
    pub fn tare_progress(&self) -> Tare {
        self.tracking.tare()
    }
}

impl<const TAXELS: usize> Default for ConditionState<TAXELS> {
    fn default() -> Self {
        ConditionState::new()
    }
}
