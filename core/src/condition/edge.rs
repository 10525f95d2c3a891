//! The Sobel operator, where it is asked for.

use super::slices::row_of;
use crate::garment::Area;

/// Slope of pressure at a taxel: eight times the counts per taxel of a plane.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Gradient {
    /// along x (columns)
    pub x: i32,
    /// along y (rows)
    pub y: i32,
}

impl Gradient {
    /// `|x| + |y|`: at most 8 times the full scale.
    pub const fn magnitude(self) -> u32 {
        self.x.unsigned_abs() + self.y.unsigned_abs()
    }
}

/// The 3x3 Sobel gradient at a taxel of a panel, the border replicated; values past the end of the slice are 0.
pub fn sobel(values: &[u16], area: &Area, row: u16, column: u16) -> Gradient {
    Neighbourhood::of(values, area, row).gradient(column.into())
}

/// A row of a panel with the one above and the one below it, itself at the border.
pub(crate) struct Neighbourhood<'a>([&'a [u16]; 3]);

impl<'a> Neighbourhood<'a> {
    /// Of no row.
    pub const NONE: Neighbourhood<'static> = Neighbourhood([&[]; 3]);

    pub fn of(values: &'a [u16], area: &Area, row: u16) -> Self {
        let last = area.rows.saturating_sub(1);
        let y = row.min(last);
        Neighbourhood([y.saturating_sub(1), y, (y + 1).min(last)].map(|row| row_of(values, area, row)))
    }

    /// The row below, which is `row` and not the last one of the panel.
    pub fn next(&self, values: &'a [u16], area: &Area, row: u16) -> Self {
        let [_, here, below] = self.0;
        Neighbourhood([here, below, row_of(values, area, row + 1)])
    }

    /// The row above, the row, the row below.
    pub const fn rows(&self) -> [&'a [u16]; 3] {
        self.0
    }

    pub fn gradient(&self, column: usize) -> Gradient {
        let x = column.min(self.0[1].len().saturating_sub(1));
        let [[nw, n, ne], [w, _, e], [sw, s, se]] = self.0.map(|row| three(row, x).map(i32::from));
        Gradient { x: ne + 2 * e + se - nw - 2 * w - sw, y: sw + 2 * s + se - nw - 2 * n - ne }
    }
}

/// A value with its neighbours to the left and right, which it replaces beyond the ends of the row.
fn three(row: &[u16], x: usize) -> [u16; 3] {
    match *row.get(x.saturating_sub(1)..).unwrap_or(&[]) {
        [middle, right, ..] if x == 0 => [middle, middle, right],
        [left, middle, right, ..] => [left, middle, right],
        [left, middle] => [left, middle, middle],
        [middle] if x == 0 => [middle; 3],
        [left] => [left, 0, 0],
        [] => [0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::{Garment, Layout};

    #[test]
    fn a_plane_has_eight_times_its_slope() {
        let layout = Layout::build(&Garment::recorded(5, 7), 35, 65535).unwrap();
        let mut values = [0u16; 35];
        for (i, value) in values.iter_mut().enumerate() {
            *value = 1000 + 3 * (i % 7) as u16 + 20 * (i / 7) as u16;
        }
        let at = |row, column| sobel(&values, &layout.areas()[0], row, column);
        assert_eq!(at(2, 3), Gradient { x: 24, y: 160 });
        assert_eq!(at(2, 3).magnitude(), 184);
        // Replicated border: half the difference is seen.
        assert_eq!(at(0, 0), Gradient { x: 12, y: 80 });
        assert_eq!(at(4, 6), Gradient { x: 12, y: 80 });
        // Total: outside and without values.
        assert_eq!(at(99, 99), at(4, 6));
        assert_eq!(sobel(&[], &layout.areas()[0], 1, 1), Gradient::default());
    }
}
