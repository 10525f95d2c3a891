//! A row of a panel, filtered run by run.

use core::ops::Range;

/// A row with the ones above and below it.
pub(super) struct Row {
    /// Where the row above, the row and the row below begin in a panel.
    pub starts: [usize; 3],
    /// At least a run and its neighbours.
    pub columns: usize,
}

impl Row {
    /// Filters some columns, and others beside them, N - 2 at a time: they have their neighbours, too.
    ///
    /// `run` filters all but the ends of some taxels, given with those above and below. `end` filters the
    /// first taxel of the row, or the last, given the first two of the row above, the row and the row below,
    /// or the last two from the last on.
    #[inline(always)]
    pub fn filter<const N: usize>(
        &self,
        values: &[u16],
        out: &mut [u16],
        columns: Range<usize>,
        run: impl Fn(&[u16; N], &[u16; N], &[u16; N], &mut [u16; N]),
        end: impl Fn([[u16; 2]; 3]) -> u16,
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
            // The last may begin within the one before: it says the same again.
            at = at.min(latest);
        }
    }

    /// Some taxels from a column on, with those above and below them.
    #[inline(always)]
    fn around<'a, const N: usize>(&self, values: &'a [u16], column: usize) -> Option<[&'a [u16; N]; 3]> {
        let [above, here, below] = self.starts;
        let above = values.get(above + column..)?.first_chunk()?;
        let here = values.get(here + column..)?.first_chunk()?;
        let below = values.get(below + column..)?.first_chunk()?;
        Some([above, here, below])
    }
}
