//! Taxels in fours, as the table lists them.

/// Number of the first of four taxels, if they follow each other; the numbers ascend.
#[inline(always)]
pub(crate) fn consecutive([first, _, _, last]: &[u16; 4]) -> Option<usize> {
    (last.wrapping_sub(*first) == 3).then_some((*first).into())
}

/// Returns the number of fours of taxels from `start` on, whose numbers ascend, that follow each other.
pub(crate) fn in_a_row(taxels: &[[u16; 4]], start: usize) -> usize {
    if let Some([.., last]) = taxels.last()
        && usize::from(*last) == start + 4 * taxels.len() - 1
    {
        // The numbers ascend: there is one taxel for each of them.
        return taxels.len();
    }
    taxels
        .iter()
        .zip((start..).step_by(4))
        .take_while(|(taxels, first)| consecutive(taxels) == Some(*first))
        .count()
}
