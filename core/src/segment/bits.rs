//! Taxels of a row as bits.

use core::ops::Range;

/// Columns of a word.
pub(crate) const WORD: u16 = u32::BITS as u16;

/// Returns the lowest run of ones.
pub(crate) const fn lowest_run(taxels: u32) -> u32 {
    taxels & !taxels.wrapping_add(taxels & taxels.wrapping_neg())
}

/// True if the ones form a single run.
pub(crate) const fn is_run(taxels: u32) -> bool {
    taxels != 0 && lowest_run(taxels) == taxels
}

/// Bit positions of a single run of ones.
pub(crate) const fn run_of(taxels: u32) -> Range<usize> {
    // Fast path of a full row of sixteen: an M0+ has no instruction that counts zeros or ones.
    if taxels == 0xffff {
        return 0..16;
    }
    let lowest = taxels & taxels.wrapping_neg();
    lowest.trailing_zeros() as usize..taxels.wrapping_add(lowest).trailing_zeros() as usize
}

/// Position of the highest one, without a count of leading zeros, which an M0+ does not have.
pub(crate) const fn highest(taxels: u32) -> u16 {
    let mut below = taxels >> 1;
    below |= below >> 1;
    below |= below >> 2;
    below |= below >> 4;
    below |= below >> 8;
    below |= below >> 16;
    below.wrapping_add(1).trailing_zeros() as u16
}

/// Returns the taxels and their neighbours in the row.
pub(crate) const fn widened(taxels: u32) -> u32 {
    taxels | taxels << 1 | taxels >> 1
}

/// Returns the runs of `taxels` that contain a taxel of `touched`, a subset of `taxels`.
pub(crate) const fn flood(taxels: u32, touched: u32) -> u32 {
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
