//! The code at rest: tare, and slow drift.
//!
//! A tare needs no memory of its own: while it runs nothing else does, and the 32-bit sums lie in the arrays of the
//! baseline (low halves) and of the calibrated image (high halves): 65535 frames of 65535 counts fit.
//!
//! Drift: each frame one row of the garment, in rotation, moves its baseline by one count towards the code, wherever
//! the taxel reads 0 and is more than one taxel away from every contact; so a held contact is never swallowed. Only a
//! tared baseline drifts: recordings are taken as they are.

use super::feedback::Feedback;
use super::image::{Rows, row_mut, row_of};
use super::progress::Tare;
use super::state::ConditionState;
use crate::format::Code;
use crate::garment::{Area, Layout};

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Takes a frame into the tare, if one runs; `true` if it did, and then there is no image.
    pub(super) fn tare_frame(&mut self, layout: &Layout, codes: &[Code], panels: u8) -> bool {
        let Tare::Running { left } = self.tracking.tare else {
            self.tracking.tare = Tare::Idle;
            return false;
        };
        let tared = match self.tracking.panels {
            Some(tared) => tared,
            None => self.begin(layout, panels),
        };
        let frames = u32::from(self.tracking.frames.max(1));
        let last = left <= 1;
        for area in areas_of(layout, tared) {
            for row in 0..area.rows {
                let low = row_mut(&mut self.baseline, area, row).iter_mut();
                let high = row_mut(&mut self.calibrated, area, row).iter_mut();
                for ((low, high), code) in low.zip(high).zip(row_of(codes, area, row)) {
                    let sum = (u32::from(*high) << 16 | u32::from(*low)).wrapping_add(u32::from(code.0));
                    (*high, *low) = ((sum >> 16) as u16, sum as u16);
                    if last {
                        (*high, *low) = (0, (sum.wrapping_add(frames / 2) / frames) as u16);
                    }
                }
            }
        }
        self.tracking.tare = if last { Tare::Done } else { Tare::Running { left: left - 1 } };
        self.tracking.tared |= last;
        true
    }

    /// Empties the image, and the sums of the panels to be tared.
    fn begin(&mut self, layout: &Layout, panels: u8) -> u8 {
        self.tracking.panels = Some(panels);
        self.calibrated.fill(0);
        self.filtered.fill(0);
        self.calibrated_rows = Rows::NONE;
        self.filtered_rows = Rows::NONE;
        for area in areas_of(layout, panels) {
            for row in 0..area.rows {
                row_mut(&mut self.baseline, area, row).fill(0);
            }
        }
        panels
    }

    /// Lets the next row of the rotation follow its codes.
    pub(super) fn follow_drift<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        codes: &[Code],
        panels: u8,
        feedback: &Feedback<CONTACTS>,
    ) {
        if !self.tracking.tared {
            return;
        }
        let turn = self.tracking.turn;
        let here = layout
            .areas()
            .iter()
            .enumerate()
            .find(|(_, area)| turn.checked_sub(area.first_row).is_some_and(|row| row < area.rows));
        // Past the last row: the rotation begins again, one frame later.
        self.tracking.turn = if here.is_some() { turn.saturating_add(1) } else { 0 };
        let Some((panel, area)) = here.filter(|(panel, _)| panels >> panel & 1 == 1) else { return };
        let row = turn - area.first_row;
        let images = row_of(&self.calibrated, area, row).iter().zip(row_of(&self.filtered, area, row));
        let taxels = row_mut(&mut self.baseline, area, row).iter_mut().zip(row_of(codes, area, row));
        for (column, ((rest, code), (before, after))) in (0u16..).zip(taxels.zip(images)) {
            if *before == 0 && *after == 0 && !feedback.holds(panel as u8, row, column) {
                *rest = if code.0 > *rest { *rest + 1 } else { *rest - u16::from(code.0 < *rest) };
            }
        }
    }
}

/// The panels of a mask.
pub(super) fn areas_of(layout: &Layout, panels: u8) -> impl Iterator<Item = &Area> {
    layout.areas().iter().enumerate().filter(move |(panel, _)| panels >> panel & 1 == 1).map(|(_, area)| area)
}
