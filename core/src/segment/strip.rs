//! Strips: consecutive runs of one label.

use super::run::Run;
use super::union_find::Label;
use crate::garment::{Area, Rect};
use crate::image::slices::row_of;

/// Consecutive runs of one label, from row to row.
pub(crate) struct Strip<'a> {
    pub runs: &'a [Run],
    pub label: &'a Label,
    pub area: &'a Area,
    /// Values of all taxels.
    pub values: &'a [u16],
}

impl Strip<'_> {
    /// Widens a rectangle of the panel so that it holds the runs.
    #[inline]
    pub fn widen(&self, rect: &mut Rect) {
        // The rows are in ascending order.
        if let [first, ..] = self.runs {
            rect.top = rect.top.min(first.row - self.area.first_row);
        }
        if let [.., last] = self.runs {
            rect.bottom = last.row - self.area.first_row;
        }
        // A `for` loop would be unrolled and begin with a division, which an M0+ does not have.
        let mut rest = self.runs;
        while let [run, after @ ..] = rest {
            rect.left = rect.left.min(run.left);
            rect.right = rect.right.max(run.right);
            rest = after;
        }
    }
}

/// Returns the values from the first to the last column of a run.
#[inline]
pub(crate) fn values_of<'a>(run: &Run, area: &Area, values: &'a [u16]) -> &'a [u16] {
    let row = row_of(values, area, run.row - area.first_row);
    row.get(run.left.into()..=run.right.into()).unwrap_or(&[])
}

/// Splits runs into strips of equal label.
pub(crate) fn strips(runs: &[Run]) -> impl Iterator<Item = &[Run]> {
    let mut rest = runs;
    // (`chunk_by` splits where it might panic.)
    core::iter::from_fn(move || {
        let label = rest.first()?.label;
        let length = rest.iter().position(|run| run.label != label).unwrap_or(rest.len());
        let (strip, after) = rest.split_at_checked(length)?;
        rest = after;
        Some(strip)
    })
}
