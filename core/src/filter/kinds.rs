//! The 3x3 filters, applied where the image may be non-zero.

use super::conservative::conservative;
use super::median::median;
#[cfg(target_pointer_width = "64")]
use super::median_simd::{FEWEST, median_simd};
use super::points::Points;
use super::square::square;
use crate::garment::Area;
use crate::image::images::Images;
use crate::image::rows::grain;
use crate::image::slices::{panel_mut, panel_of};
use serde::{Deserialize, Serialize};

/// A 3x3 filter over a panel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// No filter.
    Off,
    /// Clamps a taxel to the smallest and the largest of its eight neighbours. It removes impulses and
    /// bridges dropouts of a single taxel, and keeps fingers of 2x2 taxels, lines one taxel wide and the
    /// corners of every shape: a 3x3 median deletes all of those on a block of 4 x 16. It also removes
    /// lasting pressure on a single taxel.
    Conservative,
    /// The exact median of nine, the border replicated (as OpenCV and imageproc do).
    Median,
    /// Clamps a taxel to the greatest mean of the four 2x2 squares that it belongs to. It keeps fingers of
    /// 2x2 taxels, edges and right corners, halves lines one taxel wide and quarters impulses. For noise so
    /// strong that no taxel alone distinguishes it from a touch (`Scene::against_noise`).
    Square,
    /// Clamps like [`Filter::Conservative`], but a taxel that exceeds its neighbours keeps the value it also
    /// had in the previous frame: an impulse of one frame is removed, and a point on a single taxel passes
    /// whole from its second frame on.
    #[default]
    Persistent,
}

impl Filter {
    /// True if the filter writes a whole row of sixteen, so that the row need not be cleared before.
    pub(crate) const fn overwrites_rows(self) -> bool {
        matches!(self, Filter::Conservative | Filter::Persistent)
    }

    /// Filters the calibrated image of a panel whose filtered image is zero. The marks are widened to where
    /// either image may be non-zero.
    pub(crate) fn apply<const TAXELS: usize>(
        self,
        images: &mut Images<TAXELS>,
        points: &mut Points,
        area: &Area,
    ) {
        let Images { calibrated, filtered, rows, .. } = images;
        let values = panel_of(calibrated, area);
        let out = panel_mut(filtered, area);
        match self {
            Filter::Off => {}
            Filter::Conservative => {
                conservative(values, out, area, grain(area), rows);
            }
            Filter::Persistent => {
                if conservative(values, out, area, grain(area), rows) {
                    points.restore(values, out, area, rows);
                }
            }
            #[cfg(target_pointer_width = "64")]
            Filter::Median if usize::from(area.columns) >= FEWEST => {
                median_simd(values, out, area, grain(area), rows)
            }
            Filter::Median => median(values, out, area, grain(area), rows),
            Filter::Square => square(values, out, area, rows),
        }
    }
}
