//! The Sobel operator at single taxels.

use crate::garment::Area;

/// Slope of pressure at a taxel: eight times the counts per taxel of a plane.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Gradient {
    /// along x (columns)
    x: i32,
    /// along y (rows)
    y: i32,
}

impl Gradient {
    /// `|x| + |y|`: at most 8 times the full scale.
    pub const fn magnitude(self) -> u32 {
        self.x.unsigned_abs() + self.y.unsigned_abs()
    }
}

/// A row of a panel with the rows above and below it; at the border the row itself replaces them.
pub(crate) struct Neighbourhood<'a> {
    values: &'a [u16],
    /// Numbers of the first taxels of the row above, the row, and the row below.
    rows: [u16; 3],
    columns: u16,
}

impl<'a> Neighbourhood<'a> {
    /// Neighbourhood of a row of the panel.
    pub fn of(values: &'a [u16], area: &Area, row: u16) -> Self {
        let here = area.base + row * area.columns;
        let above = if row > 0 { here - area.columns } else { here };
        let below = if row + 1 < area.rows { here + area.columns } else { here };
        Neighbourhood { values, rows: [above, here, below], columns: area.columns }
    }

    /// 3x3 Sobel gradient at a column of the panel, border replicated; 0 if the slice is too short for it.
    pub fn gradient(&self, column: u16) -> Gradient {
        let gradient = if column == 0 || column + 1 == self.columns {
            self.gradient_beside(column)
        } else {
            self.pieces(column - 1).map(|rows| slopes(&rows))
        };
        gradient.unwrap_or_default()
    }

    /// Gradient in the first or the last column.
    fn gradient_beside(&self, column: u16) -> Option<Gradient> {
        if self.columns == 1 {
            let [[above], [here], [below]] = self.pieces(0)?;
            return Some(slopes(&[&[*above; 3], &[*here; 3], &[*below; 3]]));
        }
        Some(if column == 0 {
            let rows = self.pieces(0)?.map(|[here, east]| [*here, *here, *east]);
            slopes(&rows.each_ref())
        } else {
            let rows = self.pieces(column - 1)?.map(|[west, here]| [*west, *here, *here]);
            slopes(&rows.each_ref())
        })
    }

    /// N taxels of each row from a column on.
    fn pieces<const N: usize>(&self, column: u16) -> Option<[&'a [u16; N]; 3]> {
        let piece = |first: u16| {
            // One comparison: sums of 17 bits and a few cannot overflow.
            let from = usize::from(first) + usize::from(column);
            self.values.get(from..from + N)?.first_chunk()
        };
        let [above, here, below] = self.rows;
        Some([piece(above)?, piece(here)?, piece(below)?])
    }
}

/// Gradient at the centre of 3x3 taxels.
fn slopes([above, here, below]: &[&[u16; 3]; 3]) -> Gradient {
    let [[nw, n, ne], [w, _, e], [sw, s, se]] = [above, here, below].map(|row| row.map(i32::from));
    // Both diagonals count for both slopes.
    let (falling, rising) = (se - nw, ne - sw);
    Gradient { x: falling + rising + 2 * (e - w), y: falling - rising + 2 * (s - n) }
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
        let area = &layout.areas()[0];
        let at = |row, column| Neighbourhood::of(&values, area, row).gradient(column);
        assert_eq!(at(2, 3), Gradient { x: 24, y: 160 });
        assert_eq!(at(2, 3).magnitude(), 184);
        // Replicated border: half the difference shows.
        assert_eq!(at(0, 0), Gradient { x: 12, y: 80 });
        assert_eq!(at(4, 6), Gradient { x: 12, y: 80 });
        // Without values there is no slope.
        assert_eq!(Neighbourhood::of(&[], area, 1).gradient(1), Gradient::default());
    }
}
