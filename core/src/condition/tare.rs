//! The baseline as the mean code of some frames.
//!
//! A tare needs no memory of its own. Nothing else runs meanwhile, so the 32-bit sums lie in the arrays of
//! the baseline (low halves) and of the calibrated image (high halves): 65535 frames of 65535 counts fit.

use super::progress::Tare;
use super::rows::Rows;
use super::slices::{row_mut, row_of};
use super::state::ConditionState;
use crate::format::Code;
use crate::garment::{Area, Layout};

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Adds a frame to the tare in progress. Returns `false` if there is none; else the frame has no image.
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
        for (_, area) in areas_of(layout, tared) {
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

    /// Clears the images, and the sums of the panels to be tared.
    fn begin(&mut self, layout: &Layout, panels: u8) -> u8 {
        self.tracking.panels = Some(panels);
        self.calibrated.fill(0);
        self.filtered.fill(0);
        (self.rows, self.active) = (Rows::NONE, 0);
        self.points.forget();
        self.limits_for = None;
        self.consensus.forget();
        for (_, area) in areas_of(layout, panels) {
            for row in 0..area.rows {
                row_mut(&mut self.baseline, area, row).fill(0);
            }
        }
        panels
    }
}

/// The panels of a mask, with their index.
pub(super) fn areas_of(layout: &Layout, panels: u8) -> impl Iterator<Item = (u8, &Area)> {
    (0u8..).zip(layout.areas()).filter(move |(panel, _)| panels >> panel & 1 == 1)
}
