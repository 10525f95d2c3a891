//! The taxels of a single touch.

use crate::contact::Moments;

/// A rectangle of values, row after row: those of a touch, and 0 elsewhere. Values missing in the last row
/// count as 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patch<'a> {
    values: &'a [u16],
    columns: usize,
}

impl<'a> Patch<'a> {
    /// A patch with rows of `columns` values (at least 1).
    pub fn new(values: &'a [u16], columns: usize) -> Patch<'a> {
        Patch { values, columns: columns.max(1) }
    }

    /// The values, row after row.
    pub fn values(&self) -> &'a [u16] {
        self.values
    }

    /// Number of values in a row.
    pub fn columns(&self) -> usize {
        // Always at least 1, but only here the compiler sees it: a division by 0 would panic.
        self.columns.max(1)
    }

    /// The rows in their order.
    pub fn rows(&self) -> impl Iterator<Item = &'a [u16]> + Clone + use<'a> {
        self.values.chunks(self.columns())
    }

    /// Number of columns or of rows, whichever is greater.
    pub fn extent(&self) -> usize {
        self.columns().max(self.values.len().div_ceil(self.columns()))
    }

    /// Moments of the area: each value above 0 counts 1.
    pub fn cover(&self) -> Moments {
        let mut sum = Moments::default();
        for (row, y) in self.rows().zip(0u64..) {
            let (mut n, mut sx, mut sxx) = (0u64, 0u64, 0u64);
            for (_, x) in row.iter().zip(0u64..).filter(|(value, _)| **value > 0) {
                (n, sx, sxx) = (n + 1, sx.wrapping_add(x), sxx.wrapping_add(x.wrapping_mul(x)));
            }
            sum.add(&Moments {
                m: n,
                sx: sx as i64,
                sy: y.wrapping_mul(n) as i64,
                sxx,
                syy: y.wrapping_mul(y).wrapping_mul(n),
                sxy: y.wrapping_mul(sx) as i64,
                s2: n,
            });
        }
        sum
    }

    /// Calls `each` with every value above 0 and its eight neighbours, as rows from above; 0 beyond the border.
    pub fn neighbourhoods(&self, mut each: impl FnMut(&[[u16; 3]; 3])) {
        let below = self.rows().skip(1).chain([[].as_slice()]);
        let above = core::iter::once([].as_slice()).chain(self.rows());
        for ((above, row), below) in above.zip(self.rows()).zip(below) {
            let rows = [above, row, below];
            let first = |row: &[u16]| [0, 0, row.first().copied().unwrap_or(0)];
            let mut around = rows.map(first);
            for column in 1..=row.len() {
                for (window, row) in around.iter_mut().zip(rows) {
                    *window = [window[1], window[2], row.get(column).copied().unwrap_or(0)];
                }
                if around[1][1] > 0 {
                    each(&around);
                }
            }
        }
    }
}
