//! Rows and panels of a slice by taxel number.

use crate::garment::{Area, Layout};

/// First taxel number and length of a row.
fn place(area: &Area, row: u16) -> (usize, usize) {
    let columns = usize::from(area.columns);
    (usize::from(area.base) + usize::from(row) * columns, columns)
}

/// One row of a panel, from a slice by taxel number; shorter or empty if the slice ends.
pub(crate) fn row_of<'a, T>(values: &'a [T], area: &Area, row: u16) -> &'a [T] {
    let (start, columns) = place(area, row);
    let rest = values.get(start..).unwrap_or(&[]);
    rest.get(..columns).unwrap_or(rest)
}

/// Mutable [`row_of`].
pub(crate) fn row_mut<'a, T>(values: &'a mut [T], area: &Area, row: u16) -> &'a mut [T] {
    let (start, columns) = place(area, row);
    let rest = values.get_mut(start..).unwrap_or(&mut []);
    let length = rest.len().min(columns);
    rest.get_mut(..length).unwrap_or(&mut [])
}

/// One panel, from a slice by taxel number; shorter or empty if the slice ends.
pub(crate) fn panel_of<'a, T>(values: &'a [T], area: &Area) -> &'a [T] {
    let rest = values.get(usize::from(area.base)..).unwrap_or(&[]);
    rest.get(..usize::from(area.rows) * usize::from(area.columns)).unwrap_or(rest)
}

/// Mutable [`panel_of`].
pub(crate) fn panel_mut<'a, T>(values: &'a mut [T], area: &Area) -> &'a mut [T] {
    let rest = values.get_mut(usize::from(area.base)..).unwrap_or(&mut []);
    let length = rest.len().min(usize::from(area.rows) * usize::from(area.columns));
    rest.get_mut(..length).unwrap_or(&mut [])
}

/// The panels of a mask, with their index.
pub(crate) fn areas_of(layout: &Layout, panels: u8) -> impl Iterator<Item = (u8, &Area)> {
    (0u8..).zip(layout.areas()).filter(move |(panel, _)| panels >> panel & 1 == 1)
}
