//! The Sobel operator, where it is asked for.

use super::image::row_of;
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
    let last = (area.rows.saturating_sub(1), area.columns.saturating_sub(1));
    let (y, x) = (row.min(last.0), usize::from(column.min(last.1)));
    let (west, east) = (x.saturating_sub(1), (x + 1).min(usize::from(last.1)));
    let three = |row: u16| {
        let row = row_of(values, area, row.min(last.0));
        let at = |x: usize| row.get(x).map_or(0, |v| i32::from(*v));
        [at(west), at(x), at(east)]
    };
    let [nw, n, ne] = three(y.saturating_sub(1));
    let [w, _, e] = three(y);
    let [sw, s, se] = three(y.saturating_add(1));
    Gradient { x: ne + 2 * e + se - nw - 2 * w - sw, y: sw + 2 * s + se - nw - 2 * n - ne }
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
