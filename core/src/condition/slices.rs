//! Rows and panels as parts of a slice by taxel number.

use crate::garment::Area;

/// First taxel number and length of a row.
fn place(area: &Area, row: u16) -> (usize, usize) {
    let columns = usize::from(area.columns);
    (usize::from(area.base) + usize::from(row) * columns, columns)
}

/// The part of a slice by taxel number that is one row of a panel; shorter, or empty, where the slice ends.
pub(crate) fn row_of<'a, T>(values: &'a [T], area: &Area, row: u16) -> &'a [T] {
    let (start, columns) = place(area, row);
    let rest = values.get(start..).unwrap_or(&[]);
    rest.get(..columns).unwrap_or(rest)
}

/// As [`row_of`], to write.
pub(crate) fn row_mut<'a, T>(values: &'a mut [T], area: &Area, row: u16) -> &'a mut [T] {
    let (start, columns) = place(area, row);
    let rest = values.get_mut(start..).unwrap_or(&mut []);
    let length = rest.len().min(columns);
    rest.get_mut(..length).unwrap_or(&mut [])
}

/// The part of a slice by taxel number that is one panel; shorter, or empty, where the slice ends.
pub(crate) fn panel_of<'a, T>(values: &'a [T], area: &Area) -> &'a [T] {
    let rest = values.get(usize::from(area.base)..).unwrap_or(&[]);
    rest.get(..usize::from(area.rows) * usize::from(area.columns)).unwrap_or(rest)
}

/// As [`panel_of`], to write.
pub(super) fn panel_mut<'a, T>(values: &'a mut [T], area: &Area) -> &'a mut [T] {
    let rest = values.get_mut(usize::from(area.base)..).unwrap_or(&mut []);
    let length = rest.len().min(usize::from(area.rows) * usize::from(area.columns));
    rest.get_mut(..length).unwrap_or(&mut [])
}
