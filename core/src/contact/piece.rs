//! Pieces: the taxels of a row that belong to one part.

use core::ops::Range;

/// Columns of a word.
pub(super) const WORD: u16 = u32::BITS as u16;

/// The taxels of one part in a word: in a row, or in [`WORD`] columns of a longer one. They are whole runs, which have no
/// touched taxel beside them but in another word.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Bit `i` stands for column `column + i`; not 0.
    pub taxels: u32,
    /// All touched taxels of the word.
    pub all: u32,
    /// over all panels
    pub row: u16,
    /// First column of the word: a multiple of [`WORD`].
    pub column: u16,
    /// The part as which it was found, whose parent is the part that it belongs to.
    pub part: u16,
    /// First column that belongs to it.
    pub left: u16,
    /// Last column that belongs to it.
    pub right: u16,
    /// greatest value
    pub peak: u16,
}

impl Piece {
    /// The place of the word as one number, in the order of the pieces.
    pub const fn key(&self) -> u32 {
        key(self.row, self.column)
    }

    /// Whether there is nothing between its taxels.
    pub const fn is_run(&self) -> bool {
        is_run(self.taxels)
    }

    /// Whether no other part has a taxel of the word.
    pub const fn is_alone(&self) -> bool {
        self.taxels == self.all
    }

    /// Its runs as pieces, from left to right.
    pub fn runs(&self) -> impl Iterator<Item = Piece> {
        let (mut rest, piece) = (self.taxels, *self);
        core::iter::from_fn(move || {
            let taxels = lowest_run(rest);
            rest &= !taxels;
            (taxels != 0).then(|| Piece {
                taxels,
                left: piece.column + taxels.trailing_zeros() as u16,
                right: piece.column + (WORD - 1) - taxels.leading_zeros() as u16,
                ..piece
            })
        })
    }

    /// Whether it has the taxel of a column of its word.
    pub const fn holds(&self, column: u16) -> bool {
        self.taxels >> (column % WORD) & 1 == 1
    }

    /// Which of its taxels lie in the columns `first ..= last`.
    pub const fn within(&self, first: u16, last: u16) -> u32 {
        self.taxels & columns(self.column, first, last)
    }

    /// Which taxels of the word at `column` touch it, if they are in the next row (corners included), or in its own.
    pub const fn reach(&self, column: u16) -> u32 {
        let taxels = self.taxels;
        if self.column == column {
            taxels | taxels << 1 | taxels >> 1
        } else if self.column.wrapping_add(WORD) == column {
            taxels >> (WORD - 1)
        } else if self.column == column.wrapping_add(WORD) {
            taxels << (WORD - 1)
        } else {
            0
        }
    }
}

/// The place of a taxel's word as one number, in the order of the pieces.
pub(super) const fn key(row: u16, column: u16) -> u32 {
    (row as u32) << 16 | (column - column % WORD) as u32
}

/// The columns `first ..= last` of a row as bits of its word at `column`.
const fn columns(column: u16, first: u16, last: u16) -> u32 {
    let word = column as u32;
    let from = (first as u32).saturating_sub(word);
    let end = (last as u32 + 1).saturating_sub(word);
    // The bits below a place; all, if it is beyond the word.
    const fn below(place: u32) -> u32 {
        if place < WORD as u32 { (1 << place) - 1 } else { u32::MAX }
    }
    below(end) & !below(from)
}

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
    let first = taxels.trailing_zeros() as usize;
    first..first + taxels.count_ones() as usize
}

/// The runs of `taxels` that have one of `touched`, all of which are among them.
pub(super) const fn flood(taxels: u32, touched: u32) -> u32 {
    if is_run(taxels) {
        return taxels;
    }
    let mut runs = touched;
    loop {
        let wider = (runs | runs << 1 | runs >> 1) & taxels;
        if wider == runs {
            return runs;
        }
        runs = wider;
    }
}

/// Which of at most [`WORD`] values are not below a threshold, which is at least 1.
#[inline(never)] // the few registers of an M0+ are for its loop
pub(super) fn touched(values: &[u16], low: u16) -> u32 {
    if usize::BITS >= 64 {
        return touched_by_eights(values, low);
    }
    touched_by_sums(values, low)
}

/// One after the other, as an M0+ does best.
fn touched_by_sums(values: &[u16], low: u16) -> u32 {
    // A sum carries into bit 16 from the threshold on, which costs less than a comparison.
    let rest = (1 << 16) - u32::from(low);
    values.iter().rev().fold(0, |taxels, value| taxels << 1 | (rest + u32::from(*value)) >> 16)
}

/// The same for a machine with vectors.
fn touched_by_eights(values: &[u16], low: u16) -> u32 {
    let (eights, rest) = values.as_chunks::<8>();
    let last = rest.iter().rev().fold(0, |taxels, value| taxels << 1 | u32::from(*value >= low));
    eights.iter().rev().fold(last, |taxels, eight| {
        let marks = u64::from_le_bytes(eight.map(|value| u8::from(value >= low)));
        // Brings bit 0 of byte k to bit 56 + k; nothing carries.
        taxels << 8 | (marks.wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32
    })
}

/// What values sum up to.
#[derive(Clone, Copy)]
pub(super) struct Sum {
    /// sum f
    pub mass: u32,
    /// greatest f
    pub peak: u32,
}

impl Sum {
    /// Of nothing.
    pub const NONE: Sum = Sum { mass: 0, peak: 0 };

    /// Of all values.
    #[inline(never)] // the few registers of an M0+ are for its loop
    pub fn of(values: &[u16]) -> Sum {
        let mut sum = Sum::NONE;
        for value in values {
            sum.take((*value).into());
        }
        sum
    }

    /// Of those of a word that some bits name.
    #[inline(never)] // the few registers of an M0+ are for its loop
    pub fn named(values: &[u16], taxels: u32) -> Sum {
        let (mut sum, mut rest) = (Sum::NONE, taxels);
        for value in values {
            if rest & 1 == 1 {
                sum.take((*value).into());
            }
            rest >>= 1;
            if rest == 0 {
                break;
            }
        }
        sum
    }

    fn take(&mut self, value: u32) {
        self.mass = self.mass.wrapping_add(value);
        if value > self.peak {
            self.peak = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touched_taxels_are_those_from_the_threshold_on() {
        let mut state = 3u32;
        let mut next = || {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            state >> 16
        };
        for round in 0..2000 {
            let length = round % (usize::from(WORD) + 1);
            let low = [1, 60, 4095, u16::MAX][round % 4];
            let values: [u16; WORD as usize] =
                core::array::from_fn(|_| [0, low - 1, low, u16::MAX, next() as u16][next() as usize % 5]);
            let values = &values[..length];
            let want = (0..).zip(values).fold(0, |all, (i, value)| all | u32::from(*value >= low) << i);
            assert_eq!((touched(values, low), touched_by_sums(values, low)), (want, want));
        }
    }
}
