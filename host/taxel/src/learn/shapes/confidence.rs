//! Confidence of votes, from answers that are known to be right or wrong.

use taxel_core::format::Q15;
use taxel_core::shape::{ConfidenceTable, Recognised, STEPS};

/// Prior: this many answers with the average accuracy are added to each cell of the table.
const DOUBT: f64 = 4.0;

/// Fills the table from right answers; `mean` is the prior where there are few.
pub fn count(confidence: &mut ConfidenceTable, found: &[Recognised], hits: &[bool], mean: f64) {
    let mut cells = [[(DOUBT * mean, DOUBT); STEPS]; STEPS];
    for (found, hit) in found.iter().zip(hits) {
        let (row, column) = confidence.cell(found.share, found.distance.into());
        if let Some((right, all)) = cells.get_mut(row).and_then(|row| row.get_mut(column)) {
            *right += f64::from(u8::from(*hit));
            *all += 1.0;
        }
    }
    confidence.right =
        cells.map(|row| row.map(|(right, all)| (right / all * f64::from(Q15::ONE.0)).round() as u16));
}
