//! Expected pressure of a table at a posture.

use super::bend::{Axis, Knots};
use taxel_core::fold::{FoldRecord, FoldTable, NO_JOINT};

/// Pressure that each taxel of a table feels at a posture, counts, as it was learned: a board adds the play of
/// the sleeve and what it has corrected since. None of a fold one of whose joints stands at no known angle;
/// `degrees` gives that of a joint by its name.
pub fn expected(table: &FoldTable<'_>, degrees: impl Fn(&str) -> Option<f32>) -> Vec<(u16, Option<f32>)> {
    let mut all = Vec::new();
    for (fold, taxels) in table.folded() {
        let knots = knots(table, fold);
        let at: Option<Vec<f32>> = knots.joints.iter().map(|joint| degrees(joint)).collect();
        let around = at.map(|at| knots.around(&at));
        all.extend(taxels.iter().map(|taxel| {
            let counts = |around: [(usize, f32); 4]| {
                let mean = |knot: usize| table.cell(*taxel, knot).map_or(0.0, |cell| f32::from(cell.mean));
                let units: f32 = around.iter().map(|(knot, weight)| weight * mean(*knot)).sum();
                units * f32::from(table.unit())
            };
            (*taxel, around.map(counts))
        }));
    }
    all
}

/// The joints of a fold, and their knots.
fn knots(table: &FoldTable<'_>, fold: &FoldRecord) -> Knots {
    let own = fold.joints.iter().enumerate().filter(|(_, joint)| **joint != NO_JOINT);
    let (joints, axes) = own
        .map(|(at, joint)| {
            let axis = Axis {
                first: f32::from(fold.first[at]) / 100.0,
                step: f32::from(fold.step[at]) / 100.0,
                knots: fold.knots[at].into(),
                play: f32::from(fold.play[at]) / 100.0,
            };
            (table.joint(*joint).unwrap_or_default().to_string(), axis)
        })
        .unzip();
    Knots { joints, axes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::folds::{FoldSettings, FoldSweep, learn};
    use taxel_core::garment::{Garment, Layout};

    #[test]
    fn a_taxel_is_expected_to_feel_what_it_felt_at_that_angle() {
        let layout = Layout::build(&Garment::block(), 2048, 4095).unwrap();
        let mut sweep = FoldSweep::new(vec!["elbow".into()], layout.taxels());
        for frame in 0..2000 {
            let angle = 50.0 - 50.0 * (frame as f32 / 60.0).cos();
            let mut felt = vec![0; layout.taxels()];
            felt[20] = (4.0 * angle) as u16;
            sweep.push(&[angle], &felt).unwrap();
        }
        let settings = FoldSettings { shift_mm: 11.0, ..FoldSettings::default() };
        let learned = learn(&layout, &[sweep], &settings).unwrap();
        let table = FoldTable::check(&learned.table, &layout).unwrap();
        for angle in [15.0, 42.0, 88.0] {
            for (taxel, counts) in expected(&table, |joint| (joint == "elbow").then_some(angle)) {
                let wanted = if taxel == 20 { 4.0 * angle } else { 0.0 };
                assert!((counts.unwrap() - wanted).abs() < 10.0, "{taxel} at {angle}: {counts:?}");
            }
        }
        let unknown = expected(&table, |_| None);
        assert!(unknown.len() > 1 && unknown.iter().all(|(_, counts)| counts.is_none()));
    }
}
