//! State of the stage: the calibration of every taxel and the last image.

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
    /// Baseline codes. During a tare: the low halves of the sums.
    pub(super) baseline: [u16; TAXELS],
    /// Q4.12; 0 for absent taxels.
    pub(super) gain: [u16; TAXELS],
    /// Last inactive code of each taxel.
    pub(super) limit: [u16; TAXELS],
    /// Terms of the limits; none if the limits are not valid.
    pub(super) limits_for: Option<Terms>,
    /// True if every gain is 1, or 0, with which no taxel exceeds its limit.
    pub(super) plain: bool,
    /// Image before the filter. During a tare: the high halves of the sums.
    pub(super) calibrated: [u16; TAXELS],
    /// Image after the filter.
    pub(super) filtered: [u16; TAXELS],
    /// Where one of the images may be non-zero.
    pub(super) rows: Rows,
    /// Panels that may be non-zero.
    pub(super) active: u8,
    /// Taxels that stand out from their neighbours.
    pub(super) points: Points,
    pub(super) tracking: Progress,
    pub(super) consensus: Consensus,
    pub(super) turn: Turn,
}

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// State without a garment: every gain is 0. Call [`ConditionState::reset`] next.
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

    /// Resets for a garment: every baseline becomes `rest` (0, or full scale if pressure lowers the code),
    /// every gain 1.0, or 0 for absent taxels. Cancels a tare in progress.
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

    /// Sets the gain of a taxel, Q4.12 (4096 is 1.0); 0 silences it, like a dead taxel. Returns `false` if
    /// there is no such taxel.
    pub fn set_gain(&mut self, taxel: usize, gain: u16) -> bool {
        let Some(held) = self.gain.get_mut(taxel) else { return false };
        *held = gain;
        self.set_limit(taxel);
        true
    }

    /// Restores the baseline of a taxel as if by a tare; all baselines follow drift from then on. Returns
    /// `false` if there is no such taxel or a tare is in progress.
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

    /// Baseline codes by taxel number; none during a tare.
    pub fn baseline(&self) -> Option<&[u16]> {
        (!matches!(self.tracking.tare(), Tare::Running { .. })).then_some(&self.baseline)
    }

    /// Drift of a panel since the start, as its witnesses agree, counts modulo 2^32: only differences are
    /// meaningful.
    pub fn drifted(&self, panel: u8) -> i32 {
        self.consensus.drifted(panel)
    }

    /// Gains by taxel number, Q4.12.
    pub fn gain(&self) -> &[u16] {
        &self.gain
    }

    /// Takes the mean code of the next `frames` frames (at least 1) as the baseline; a tare in progress
    /// starts again. Tares the panels that the first of these frames reads; the others keep their baseline.
    /// The old baseline is lost at once. The caller must not tare under load, and must say so if contacts are
    /// present.
    pub fn tare(&mut self, frames: u16) {
        self.tracking.request(frames.max(1));
    }

    /// Progress of the tare.
    pub fn tare_progress(&self) -> Tare {
        self.tracking.tare()
    }
}

impl<const TAXELS: usize> Default for ConditionState<TAXELS> {
    fn default() -> Self {
        ConditionState::new()
    }
}
