//! Drift of the baseline, in counts per second.
//!
//! In each [turn](super::rates::TURN_US), or half of it while a panel drifts fast, every row is visited once,
//! whatever the frame rate. Its taxels move by the common drift of their panel
//! ([`Consensus`](super::consensus::Consensus)). Taxels farther than one taxel from any contact then move on
//! towards their own codes by as much as taxels may differ from their panel. A taxel that shows no pressure
//! moves on by half of the common drift, beside a contact, too: otherwise the surroundings of a contact that
//! is held for long would drift apart from their panel and join it. A held contact is therefore never absorbed
//! by the baseline, nor is a slow one once it shows.
//!
//! While a panel drifts, what grows no faster is drift ([`DriftPace`]): a contact holds the baseline where it
//! lay when it last rose faster. While drift is fast, a contact that may be nothing else holds none, so that
//! it ends; and a taxel with less than a sixteenth of a contact's peak does not belong to the contact:
//! otherwise the surroundings of a contact would not follow, drift away from the panel, join the
//! contact, and stop their own surroundings. A taxel on which the garment's fold presses moves by the common
//! drift alone. Only a tared baseline drifts; recordings are used unchanged.

use super::consensus::Consensus;
#[cfg(doc)]
use super::consensus::DriftPace;
use super::feedback::Feedback;
use super::missed::Followed;
use super::rates::{OWN, beside, under};
use super::tracking::Tracking;
use crate::calibrate::calibration::TaxelCalibration;
use crate::calibrate::sampled::Sampled;
use crate::calibrate::terms::LimitTerms;
use crate::fold::FoldState;
use crate::garment::{Area, Layout};
use crate::image::images::Images;
use crate::image::slices::{panel_of, row_mut, row_of};

/// A frame that the baselines follow.
struct Drift<'a, const TAXELS: usize, const CONTACTS: usize> {
    calibration: &'a mut TaxelCalibration<TAXELS>,
    images: &'a Images<TAXELS>,
    sampled: &'a Sampled<'a>,
    feedback: &'a Feedback<CONTACTS>,
    folds: &'a FoldState,
    terms: LimitTerms,
}

impl Tracking {
    /// Updates the rows that are due. The witnesses of a panel have slots of their own, before its rows and
    /// before the second half of them, so that all frames cost alike.
    pub(crate) fn follow_drift<const TAXELS: usize, const CONTACTS: usize>(
        &mut self,
        (calibration, images): (&mut TaxelCalibration<TAXELS>, &Images<TAXELS>),
        layout: &Layout,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        (folds, terms): (&FoldState, LimitTerms),
    ) {
        if !self.progress.tared {
            return;
        }
        let mut drift = Drift { calibration, images, sampled, feedback, folds, terms };
        let rows = layout.areas().last().map_or(0, |area| area.first_row.saturating_add(area.rows));
        let slots = rows.saturating_add(2 * layout.areas().len() as u16);
        while let Some(slot) = self.turn.next(sampled.now, slots, self.consensus.is_fast()) {
            let here = (0u8..).zip(layout.areas()).find_map(|(panel, area)| {
                let at = slot.checked_sub(area.first_row.saturating_add(2 * u16::from(panel)))?;
                (at <= area.rows + 1).then_some((panel, area, at))
            });
            let Some((panel, area, at)) = here.filter(|(panel, ..)| sampled.panels >> panel & 1 == 1) else {
                continue;
            };
            let half = 1 + area.rows / 2;
            if at == 0 || at == half {
                drift.ask(&mut self.consensus, panel, area, at == 0);
            } else {
                drift.follow(&mut self.consensus, panel, area, at - 1 - u16::from(at > half));
            }
        }
    }
}

impl<const TAXELS: usize, const CONTACTS: usize> Drift<'_, TAXELS, CONTACTS> {
    /// Takes the votes of a panel's witnesses; `whole`: its turn begins.
    fn ask(&self, consensus: &mut Consensus, panel: u8, area: &Area, whole: bool) {
        let Drift { calibration, images, sampled, feedback, folds, .. } = self;
        let columns = usize::from(area.columns);
        let pace = consensus.pace(panel);
        let images = (panel_of(&images.calibrated, area), panel_of(&images.filtered, area));
        let taxels: (&[u16], &[u16]) = (&calibration.baseline, &calibration.gain);
        consensus.vote(panel, area, sampled.codes, taxels, whole, |at| {
            let row = at.checked_div(columns).unwrap_or(0);
            let shown = images.0.get(at).max(images.1.get(at)).copied().unwrap_or(0);
            folds.holds(usize::from(area.base) + at)
                || feedback.presses(panel, row as u16, at.wrapping_sub(row * columns) as u16, shown, pace)
        });
    }

    /// Moves the baselines of a row.
    fn follow(&mut self, consensus: &mut Consensus, panel: u8, area: &Area, row: u16) {
        let feedback = self.feedback;
        let common = consensus.step(panel);
        let beside = beside(common);
        let touched = feedback.touches(panel, row, 0, area.columns);
        let first = usize::from(area.base) + usize::from(row) * usize::from(area.columns);
        let folds = self.folds;
        let folded = folds.holds_any(first..first + usize::from(area.columns));
        if !touched && !folded && !self.images.rows.contains(area.first_row.saturating_add(row)) {
            let followed = self.follow_row(area, row, common, |_, _| beside + OWN, |_| 0);
            return consensus.measure(panel, followed);
        }
        let common = if touched { common + consensus.missed(panel) } else { common };
        let pace = consensus.pace(panel);
        let is_held = |column: u16| folded && folds.holds(first + usize::from(column));
        let own = |column: u16, shown: u16| match touched && feedback.presses(panel, row, column, shown, pace)
        {
            _ if is_held(column) => 0,
            true if shown == 0 => under(common),
            true => 0,
            false if shown == 0 => beside + OWN,
            false => beside,
        };
        let level = |column: u16| if folded { folds.level(first + usize::from(column)) } else { 0 };
        let followed = self.follow_row(area, row, common, own, level);
        if !touched && !folded {
            consensus.measure(panel, followed);
        }
    }

    /// Moves the baselines of a row by `common`, and from there towards each taxel's code by at most
    /// `own(column, shown pressure)`. `level(column)`: what the garment's fold may press there, counts.
    #[inline(always)]
    fn follow_row(
        &mut self,
        area: &Area,
        row: u16,
        common: i32,
        own: impl Fn(u16, u16) -> i32,
        level: impl Fn(u16) -> u16,
    ) -> Followed {
        let Drift { calibration, images, sampled, terms, .. } = self;
        let silent = terms.silent();
        let TaxelCalibration { baseline, gain, limit, .. } = &mut **calibration;
        let images = row_of(&images.calibrated, area, row).iter().zip(row_of(&images.filtered, area, row));
        let limits = row_mut(limit, area, row).iter_mut().zip(row_of(gain, area, row));
        let taxels = row_mut(baseline, area, row).iter_mut().zip(limits);
        let mut followed = Followed::default();
        for (column, ((rest, (limit, gain)), (code, (before, after)))) in
            (0u16..).zip(taxels.zip(row_of(sampled.codes, area, row).iter().zip(images)))
        {
            let was = i32::from(*rest);
            let own = own(column, *before.max(after));
            let beyond = i32::from(code.0) - was - common;
            let step = common + beyond.min(own).max(-own);
            let now = (was + step).clamp(0, 0xffff);
            let step = now - was;
            if *gain != 0 {
                followed.count += 1;
                followed.distance = followed.distance.saturating_add(beyond.unsigned_abs());
                followed.beyond = followed.beyond.saturating_add(step - common);
            }
            if step == 0 {
                continue;
            }
            *rest = now as u16;
            *limit = match *limit {
                // Saturated: the true limit may lie beyond the range, so it is computed again.
                same if same == silent => terms.limit_beyond(level(column), *rest, *gain),
                limit => (i32::from(limit) + step).clamp(0, 0xffff) as u16,
            };
        }
        followed
    }
}
