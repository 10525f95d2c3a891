//! Codes to pressure, for the taxels beyond their limits only.

use super::calibration::TaxelCalibration;
use super::marks::Marks;
use super::panel::PanelCodes;
use crate::format::Code;
use crate::garment::Area;
use crate::image::images::Images;
use crate::image::slices::{panel_mut, panel_of};

/// Calibrates a panel whose calibrated image is empty, or whose chunks are rows. Returns true if any taxel is
/// active. Writes only where something is or was marked.
pub(crate) fn calibrate<const TAXELS: usize>(
    calibration: &TaxelCalibration<TAXELS>,
    images: &mut Images<TAXELS>,
    area: &Area,
    codes: &[Code],
    falling: bool,
) -> bool {
    let limit = panel_of(&calibration.limit, area);
    let codes = panel_of(codes, area);
    let there = limit.len().min(codes.len());
    let panel = PanelCodes {
        codes: codes.get(..there).unwrap_or(codes),
        limit: limit.get(..there).unwrap_or(limit),
        rest: panel_of(&calibration.baseline, area),
        gain: panel_of(&calibration.gain, area),
        out: panel_mut(&mut images.calibrated, area),
    };
    let marks = Marks::of(&mut images.rows, area);
    let margin = calibration.margin_of_unity();
    if falling {
        calibrate_panel::<true>(panel, marks, margin)
    } else {
        calibrate_panel::<false>(panel, marks, margin)
    }
}

/// `unity`: the largest inactive difference of a code from its baseline, if every gain is 1.
fn calibrate_panel<const FALLING: bool>(
    mut panel: PanelCodes<'_>,
    mut marks: Marks<'_>,
    unity: Option<u16>,
) -> bool {
    #[cfg(target_pointer_width = "64")]
    if let Some(margin) = unity.filter(|_| marks.are_chunks16() && panel.codes.len() == panel.out.len()) {
        return panel.calibrate_rows::<FALLING>(&mut marks, margin);
    }
    panel.calibrate_chunks::<FALLING>(&mut marks, unity)
}
