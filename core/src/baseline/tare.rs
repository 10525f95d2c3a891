//! The baseline as the mean code of some frames.
//!
//! A tare needs no memory of its own. Nothing else runs meanwhile, so the 32-bit sums lie in the arrays of
//! the baseline (low halves) and of the calibrated image (high halves): 65535 frames of 65535 counts fit.

use super::progress::Tare;
use super::tracking::Tracking;
use crate::calibrate::calibration::TaxelCalibration;
use crate::format::Code;
use crate::garment::Layout;
use crate::image::images::Images;
use crate::image::slices::{areas_of, row_mut, row_of};

impl Tracking {
    /// Adds a frame to the tare in progress. Returns `false` if there is none; else the frame has no image.
    pub(crate) fn tare_frame<const TAXELS: usize>(
        &mut self,
        calibration: &mut TaxelCalibration<TAXELS>,
        images: &mut Images<TAXELS>,
        layout: &Layout,
        codes: &[Code],
        panels: u8,
    ) -> bool {
        let Tare::Running { left } = self.progress.tare else {
            self.progress.tare = Tare::Idle;
            return false;
        };
        let tared = match self.progress.panels {
            Some(tared) => tared,
            None => self.begin(calibration, images, layout, panels),
        };
        let frames = u32::from(self.progress.frames.max(1));
        let last = left <= 1;
        for (_, area) in areas_of(layout, tared) {
            for row in 0..area.rows {
                let low = row_mut(&mut calibration.baseline, area, row).iter_mut();
                let high = row_mut(&mut images.calibrated, area, row).iter_mut();
                for ((low, high), code) in low.zip(high).zip(row_of(codes, area, row)) {
                    let sum = (u32::from(*high) << 16 | u32::from(*low)).wrapping_add(u32::from(code.0));
                    (*high, *low) = ((sum >> 16) as u16, sum as u16);
                    if last {
                        (*high, *low) = (0, (sum.wrapping_add(frames / 2) / frames) as u16);
                    }
                }
            }
        }
        self.progress.tare = if last { Tare::Done } else { Tare::Running { left: left - 1 } };
        self.progress.tared |= last;
        true
    }

    /// Clears the images, and the sums of the panels to be tared.
    fn begin<const TAXELS: usize>(
        &mut self,
        calibration: &mut TaxelCalibration<TAXELS>,
        images: &mut Images<TAXELS>,
        layout: &Layout,
        panels: u8,
    ) -> u8 {
        self.progress.panels = Some(panels);
        images.reset();
        calibration.limits_for = None;
        self.consensus.forget();
        for (_, area) in areas_of(layout, panels) {
            for row in 0..area.rows {
                row_mut(&mut calibration.baseline, area, row).fill(0);
            }
        }
        panels
    }
}
