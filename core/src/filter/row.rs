//! Filters a row of a panel run by run.

use core::ops::Range;

/// A row with the rows above and below it.
pub(crate) struct FilterRow {
    /// Offsets in a panel of the row above, the row, and the row below.
    pub starts: [usize; 3],
    /// Number of columns: at least a run with its two neighbours.
    pub columns: usize,
}

impl FilterRow {
    /// Filters `columns`, N - 2 at a time, and possibly some beside them.
    ///
    /// `run` filters N taxels except both ends, given the rows above, here and below. `end` filters the first
    /// or the last taxel of the row, given the two taxels of each of the three rows at that end, outermost
    /// first.
    #[inline(always)]
    pub fn filter<const N: usize>(
        &self,
        values: &[u16],
        out: &mut [u16],
        columns: Range<usize>,
        mut run: impl FnMut(&[u16; N], &[u16; N], &[u16; N], &mut [u16; N]),
        mut end: impl FnMut([[u16; 2]; 3]) -> u16,
    ) {
        let Some(latest) = self.columns.checked_sub(N) else { return };
        let mut at = columns.start.saturating_sub(1).min(latest);
        loop {
            let Some([above, here, below]) = self.around::<N>(values, at) else { return };
            let Some(out) = out.get_mut(self.starts[1] + at..).and_then(<[u16]>::first_chunk_mut) else {
                return;
            };
            run(above, here, below, out);
            if at == 0 {
                out[0] = end([above, here, below].map(|row| [row[0], row[1]]));
            }
            if at == latest {
                out[N - 1] = end([above, here, below].map(|row| [row[N - 1], row[N - 2]]));
                return;
            }
            at += N - 2;
            if at + 1 >= columns.end {
                return;
            }
            // The last run may overlap the previous one, with equal results.
            at = at.min(latest);
        }
    }

    /// N taxels from a column on, with those above and below them.
    #[inline(always)]
    fn around<'a, const N: usize>(&self, values: &'a [u16], column: usize) -> Option<[&'a [u16; N]; 3]> {
        let [above, here, below] = self.starts;
        let above = values.get(above + column..)?.first_chunk()?;
        let here = values.get(here + column..)?.first_chunk()?;
        let below = values.get(below + column..)?.first_chunk()?;
        Some([above, here, below])
    }
}
