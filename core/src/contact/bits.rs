//! Taxels of a row as bits.

use core::ops::Range;

/// Columns of a word.
pub(super) const WORD: u16 = u32::BITS as u16;

/// The lowest run of ones.
pub(super) const fn lowest_run(taxels: u32) -> u32 {
    taxels & !taxels.wrapping_add(taxels & taxels.wrapping_neg())
}

/// Whether there is one run of ones.
pub(super) const fn is_run(taxels: u32) -> bool {
    taxels != 0 && lowest_run(taxels) == taxels
}

/// The places of one run of ones.
pub(super) const fn run_of(taxels: u32) -> Range<usize> {
    // A whole row of sixteen: an M0+ takes long to count zeros, and longer to count ones.
    if taxels == 0xffff {
        return 0..16;
    }
    let lowest = taxels & taxels.wrapping_neg();
    lowest.trailing_zeros() as usize..taxels.wrapping_add(lowest).trailing_zeros() as usize
}

/// The place of the highest one. An M0+ counts no leading zeros.
pub(super) const fn highest(taxels: u32) -> u16 {
    let mut below = taxels >> 1;
    below |= below >> 1;
    below |= below >> 2;
    below |= below >> 4;
    below |= below >> 8;
    below |= below >> 16;
    below.wrapping_add(1).trailing_zeros() as u16
}

/// Some taxels and those beside them.
pub(super) const fn widened(taxels: u32) -> u32 {
    taxels | taxels << 1 | taxels >> 1
}

/// The runs of `taxels` that have one of `touched`, all of which are among them.
pub(super) const fn flood(taxels: u32, touched: u32) -> u32 {
    if is_run(taxels) {
        return taxels;
    }
    let mut runs = touched;
    loop {
        let wider = widened(runs) & taxels;
        if wider == runs {
            return runs;
        }
        runs = wider;
    }
}
