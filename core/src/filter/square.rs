//! Clamps a taxel to the best 2x2 square that holds it.

use crate::garment::Area;
use crate::image::rows::Rows;

/// Clamps each taxel of a panel to the greatest mean of the four 2x2 squares that it belongs to; beyond the
/// border there is 0. `out` is zero outside the marks.
pub(crate) fn square(values: &[u16], out: &mut [u16], area: &Area, marks: &Rows) {
    let columns = usize::from(area.columns);
    let (first, end) = (area.first_row, area.first_row.saturating_add(area.rows));
    let mut next = first;
    while let Some(number) = marks.next(next..end) {
        next = number + 1;
        let start = usize::from(number - first) * columns;
        let line =
            |start: Option<usize>| start.and_then(|start| values.get(start..start + columns)).unwrap_or(&[]);
        let Some(out) = out.get_mut(start..start + columns) else { return };
        row(line(start.checked_sub(columns)), line(Some(start)), line(Some(start + columns)), out);
    }
}

/// Filters one row; the rows above and below are empty if they do not exist.
#[inline(never)]
fn row(above: &[u16], here: &[u16], below: &[u16], out: &mut [u16]) {
    let at = |row: &[u16], column: usize| row.get(column).map_or(0, |value| u32::from(*value));
    // Sums with the taxel above, and with the one below.
    let columns =
        |column: usize| [at(above, column) + at(here, column), at(here, column) + at(below, column)];
    let mut left = [0, 0];
    let mut middle = columns(0);
    for (column, (value, out)) in here.iter().zip(out).enumerate() {
        let right = columns(column + 1);
        if *value != 0 {
            let best = (left[0] + middle[0])
                .max(left[1] + middle[1])
                .max(middle[0] + right[0])
                .max(middle[1] + right[1]);
            *out = u32::from(*value).min((best + 2) >> 2) as u16;
        }
        (left, middle) = (middle, right);
    }
}
