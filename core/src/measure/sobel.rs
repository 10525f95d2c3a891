//! The Sobel operator at single taxels.

use crate::garment::Area;
use crate::image::row16::{ROW16, Row16};

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

    /// The three rows, if they have sixteen columns.
    pub fn rows16(&self) -> Option<[&'a Row16; 3]> {
        if usize::from(self.columns) == ROW16 { self.pieces(0) } else { None }
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

/// Sum of the gradients' magnitudes, each divided by 8 and truncated, at the taxels of the middle one of
/// three rows of sixteen that are in the mask `taxels` (a bit per column).
///
/// On a Cortex-M0+ a taxel in the mask takes 40 cycles, any other 4 (counted in instructions), as no bounds
/// are checked.
#[inline(never)] // M0+: out of line
pub(crate) fn steepness_of_rows16(rows: [&Row16; 3], taxels: u32) -> u32 {
    // Unrolled by hand: the compiler would keep a loop, with an index and a shift per taxel.
    let sum = at::<0, 0, 1>(rows, taxels, 0);
    let sum = at::<0, 1, 2>(rows, taxels, sum);
    let sum = at::<1, 2, 3>(rows, taxels, sum);
    let sum = at::<2, 3, 4>(rows, taxels, sum);
    let sum = at::<3, 4, 5>(rows, taxels, sum);
    let sum = at::<4, 5, 6>(rows, taxels, sum);
    let sum = at::<5, 6, 7>(rows, taxels, sum);
    let sum = at::<6, 7, 8>(rows, taxels, sum);
    let sum = at::<7, 8, 9>(rows, taxels, sum);
    let sum = at::<8, 9, 10>(rows, taxels, sum);
    let sum = at::<9, 10, 11>(rows, taxels, sum);
    let sum = at::<10, 11, 12>(rows, taxels, sum);
    let sum = at::<11, 12, 13>(rows, taxels, sum);
    let sum = at::<12, 13, 14>(rows, taxels, sum);
    let sum = at::<13, 14, 15>(rows, taxels, sum);
    at::<14, 15, 15>(rows, taxels, sum)
}
#[inline(always)]
fn at<const LEFT: usize, const HERE: usize, const RIGHT: usize>(
    rows: [&Row16; 3],
    taxels: u32,
    sum: u32,
) -> u32 {
    if taxels & 1 << HERE == 0 {
        return sum;
    }
    let around = rows.map(|row| [row[LEFT], row[HERE], row[RIGHT]]);
    sum + (slopes(&around.each_ref()).magnitude() >> 3)
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
    fn rows_of_sixteen_are_as_others() {
        let layout = Layout::build(&Garment::recorded(3, ROW16 as u16), 48, 65535).unwrap();
        let mut noise = 1u32;
        let values: [u16; 48] = core::array::from_fn(|_| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 16) as u16
        });
        for row in 0..3 {
            let around = Neighbourhood::of(&values, &layout.areas()[0], row);
            let rows = around.rows16().unwrap();
            for taxels in [0, 1, 0x8000, 0x5a3c, 0xffff] {
                let columns = (0..ROW16 as u16).filter(|column| taxels & 1 << column != 0);
                let sum: u32 = columns.map(|column| around.gradient(column).magnitude() >> 3).sum();
                assert_eq!(steepness_of_rows16(rows, taxels), sum);
            }
        }
        let other = Layout::build(&Garment::recorded(3, 15), 45, 65535).unwrap();
        assert!(Neighbourhood::of(&values, &other.areas()[0], 1).rows16().is_none());
    }

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
