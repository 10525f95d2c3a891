//! The baseline follows slow drift.
//!
//! Each frame one row of the garment, in rotation, moves its baseline by one count towards the code, wherever the taxel
//! reads 0 and is more than one taxel away from every contact. The other taxels, so that a held contact is never swallowed,
//! move as the panel as a whole does ([`Consensus`](super::consensus::Consensus)). Only a tared baseline drifts: recordings
//! are taken as they are.

use super::feedback::Feedback;
use super::slices::{row_mut, row_of};
use super::state::ConditionState;
use super::terms::Terms;
use crate::format::Code;
use crate::garment::{Area, Layout};

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Lets the next row of the rotation follow its codes.
    pub(super) fn follow_drift<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        codes: &[Code],
        panels: u8,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        if !self.tracking.tared {
            return;
        }
        let turn = self.tracking.turn;
        let here = (0u8..).zip(layout.areas()).find_map(|(panel, area)| {
            let row = turn.checked_sub(area.first_row).filter(|row| *row < area.rows)?;
            Some((panel, area, row))
        });
        // Past the last row: the rotation begins again, one frame later.
        self.tracking.turn = if here.is_some() { turn.saturating_add(1) } else { 0 };
        let Some((panel, area, row)) = here.filter(|(panel, ..)| panels >> panel & 1 == 1) else { return };
        if row == 0 {
            self.consensus.vote(panel, area, &self.baseline, &self.gain);
        }
        let touched = feedback.touches(panel, row, 0, area.columns);
        if !touched && !self.rows.contains(turn) {
            return self.follow_row(area, row, codes, terms, |_, _| None);
        }
        let step = self.consensus.step(panel);
        self.follow_row(area, row, codes, terms, |column, quiet| {
            (!quiet || touched && feedback.holds(panel, row, column)).then_some(step)
        });
    }

    /// Moves the baseline of a row: each taxel towards its code, or as `frozen` says of its column and of whether it
    /// reads 0.
    #[inline(always)]
    fn follow_row(
        &mut self,
        area: &Area,
        row: u16,
        codes: &[Code],
        terms: Terms,
        frozen: impl Fn(u16, bool) -> Option<i32>,
    ) {
        let silent = terms.silent();
        let images = row_of(&self.calibrated, area, row).iter().zip(row_of(&self.filtered, area, row));
        let limits = row_mut(&mut self.limit, area, row).iter_mut().zip(row_of(&self.gain, area, row));
        let taxels = row_mut(&mut self.baseline, area, row).iter_mut().zip(limits);
        for (column, ((rest, (limit, gain)), (code, (before, after)))) in
            (0u16..).zip(taxels.zip(row_of(codes, area, row).iter().zip(images)))
        {
            let was = i32::from(*rest);
            let step = frozen(column, *before == 0 && *after == 0)
                .unwrap_or_else(|| (i32::from(code.0) - was).signum());
            let now = was + step;
            if step == 0 || !(0..=0xffff).contains(&now) {
                continue;
            }
            *rest = now as u16;
            *limit = match *limit {
                // It would be further away, if there were codes.
                same if same == silent => terms.limit(*rest, terms.margin(*gain)),
                limit => (i32::from(limit) + step) as u16,
            };
        }
    }
}
