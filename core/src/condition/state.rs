//! State of the stage: the calibration of every taxel and the last image.

use crate::baseline::consensus::DriftPace;
use crate::baseline::progress::Tare;
use crate::baseline::tracking::Tracking;
use crate::calibrate::calibration::TaxelCalibration;
use crate::filter::points::Points;
#[cfg(feature = "folds")]
use crate::fold::FoldTable;
use crate::fold::{FoldState, PostureState};
use crate::format::Code;
#[cfg(feature = "folds")]
use crate::format::Name;
use crate::garment::{Layout, PANELS};
use crate::image::images::Images;

/// Baseline, gain and image of every taxel.
#[derive(Debug, Clone)]
pub struct ConditionState<const TAXELS: usize> {
    pub(super) calibration: TaxelCalibration<TAXELS>,
    pub(super) images: Images<TAXELS>,
    /// Taxels that stand out from their neighbours.
    pub(super) points: Points,
    pub(super) tracking: Tracking,
    /// Pressure of the garment's folds.
    pub(super) folds: FoldState,
}

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// The last image before the filter.
    pub(crate) fn calibrated(&self) -> &[u16] {
        &self.images.calibrated
    }

    /// State without a garment: every gain is 0. Call [`ConditionState::reset`] next.
    pub const fn new() -> Self {
        ConditionState {
            calibration: TaxelCalibration::new(),
            images: Images::new(),
            points: Points::new(),
            tracking: Tracking::new(),
            folds: FoldState::new(),
        }
    }

    /// Resets for a garment: every baseline becomes `rest` (0, or full scale if pressure lowers the code),
    /// every gain 1.0, or 0 for absent taxels. Cancels a tare in progress.
    pub fn reset(&mut self, layout: &Layout, rest: Code) {
        self.calibration.reset(layout, rest);
        self.images.reset();
        self.points.forget();
        self.tracking.reset();
        self.folds.forget();
    }

    /// Returns the expected pressure of the garment's folds.
    pub fn folds(&self) -> &FoldState {
        &self.folds
    }

    /// Angles of the joints, as the host sends them.
    pub fn posture_mut(&mut self) -> &mut PostureState {
        &mut self.folds.posture
    }

    /// Puts a table of folds in force, or none; `joints` are the scene's.
    #[cfg(feature = "folds")]
    pub(crate) fn use_folds(&mut self, table: Option<FoldTable<'static>>, joints: &[Name]) {
        self.folds.use_folds(table, joints);
        // The limits are those of the table before.
        self.calibration.limits_for = None;
    }

    /// Sets the gain of a taxel, Q4.12 (4096 is 1.0); 0 silences it, like a dead taxel. Returns `false` if
    /// there is no such taxel.
    pub fn set_gain(&mut self, taxel: usize, gain: u16) -> bool {
        let Some(held) = self.calibration.gain.get_mut(taxel) else { return false };
        *held = gain;
        self.calibration.set_limit(taxel, self.folds.level(taxel));
        true
    }

    /// Restores the baseline of a taxel as if by a tare; all baselines follow drift from then on. Returns
    /// `false` if there is no such taxel or a tare is in progress.
    pub fn set_baseline(&mut self, taxel: usize, rest: Code) -> bool {
        if matches!(self.tracking.progress.tare(), Tare::Running { .. }) {
            return false;
        }
        let Some(held) = self.calibration.baseline.get_mut(taxel) else { return false };
        *held = rest.0;
        self.tracking.progress.mark_tared();
        self.tracking.consensus.forget();
        self.calibration.set_limit(taxel, self.folds.level(taxel));
        true
    }

    /// Baseline codes by taxel number; none during a tare.
    pub fn baseline(&self) -> Option<&[u16]> {
        (!matches!(self.tracking.progress.tare(), Tare::Running { .. })).then_some(&self.calibration.baseline)
    }

    /// Drift of a panel since the start, as its witnesses agree, counts modulo 2^32: only differences are
    /// meaningful.
    pub fn drifted(&self, panel: u8) -> i32 {
        self.tracking.consensus.drifted(panel)
    }

    /// True while a panel drifts fast, and for some seconds after it did.
    pub fn drifts_fast(&self) -> bool {
        self.tracking.consensus.was_fast()
    }

    /// How fast a panel drifts, or did in the last seconds.
    pub(crate) fn pace(&self, panel: u8) -> DriftPace {
        self.tracking.consensus.pace(panel)
    }

    /// Least peak that is clear of the noise of each panel, counts.
    pub(crate) fn clear_of_noise(&self) -> [u16; PANELS] {
        self.tracking.consensus.clear_of_noise()
    }

    /// Rise of a peak within half a second that drift and noise of a panel may cause, counts.
    pub(crate) fn unexplained_rise(&self, panel: u8) -> u16 {
        self.tracking.consensus.unexplained_rise(panel)
    }

    /// Gains by taxel number, Q4.12.
    pub fn gain(&self) -> &[u16] {
        &self.calibration.gain
    }

    /// Last code of a taxel with less than `level` counts of pressure; the end of the range for a silenced
    /// taxel. Folds press, too: a level is beyond what they may.
    pub fn inactive_code(&self, taxel: usize, level: u16, falling: bool) -> u16 {
        let folds = self.folded(taxel);
        let level =
            folds.map_or(level, |[expected, doubt]| level.saturating_add(expected).saturating_add(doubt));
        self.calibration.inactive_code(taxel, level, falling)
    }

    /// Returns the expected pressure of folds on a taxel and its doubt, counts; none where nothing is expected.
    /// A bit says so sooner than the search for the taxel.
    fn folded(&self, taxel: usize) -> Option<[u16; 2]> {
        let taxel = u16::try_from(taxel).ok().filter(|_| self.folds.holds(taxel))?;
        self.folds.of(taxel)
    }

    /// Pressure of a taxel at a code, counts, beyond what its folds are expected to press.
    pub(crate) fn felt(&self, taxel: usize, code: Code, falling: bool) -> u16 {
        let folds = self.folded(taxel);
        let expected = folds.map_or(0, |[expected, _]| expected);
        self.pressure(taxel, code, falling).saturating_sub(expected)
    }

    /// Pressure of a taxel at a code, counts.
    pub fn pressure(&self, taxel: usize, code: Code, falling: bool) -> u16 {
        self.calibration.pressure(taxel, code, falling)
    }

    /// Takes the mean code of the next `frames` frames (at least 1) as the baseline; a tare in progress
    /// starts again. Tares the panels that the first of these frames reads; the others keep their baseline.
    /// The old baseline is lost at once. The caller must not tare under load, and must say so if contacts are
    /// present.
    pub fn tare(&mut self, frames: u16) {
        self.tracking.progress.request(frames.max(1));
        self.folds.forget();
    }

    /// Progress of the tare.
    pub fn tare_progress(&self) -> Tare {
        self.tracking.progress.tare()
    }
}

impl<const TAXELS: usize> Default for ConditionState<TAXELS> {
    fn default() -> Self {
        ConditionState::new()
    }
}
