//! Sums over the taxels of a contact: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be told from an impulse. What
//! it cuts from a crest is part of the force: a taxel counts with its value before the filter, unless that
//! exceeds the filtered one by more than noise, which an impulse does.

use super::taxel::TaxelRecord;
use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;
use crate::segment::run::Run;

/// Greatest value of which [`TOGETHER`] products fit in 31 bits: 4095 * 2^15 * 16 < 2^31.
const COMMON: u16 = 4095;
/// Taxels whose products are added in 32 bits.
const TOGETHER: usize = 16;

/// What taxels press on their link: sums over values in counts, and records in units of 2^-14.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressSums {
    /// Sum of value times normal.
    pub force: [i64; 3],
    /// Sum of value times arm.
    pub moment: [i64; 3],
    /// Sum of the values.
    pub pressed: u32,
}

impl PressSums {
    /// Nothing presses.
    pub const NONE: PressSums = PressSums { force: [0; 3], moment: [0; 3], pressed: 0 };

    /// Adds the taxels of a run, whose values before and after the filter are those of the columns from its
    /// first to its last one, as are the records.
    #[inline(never)] // M0+: out of line
    pub fn press(&mut self, (calibrated, filtered): (&[u16], &[u16]), run: &Run, records: &[TaxelRecord]) {
        self.pressed = self.pressed.wrapping_add(run.sums.s0);
        let taxels = run.rebased();
        // Without a gap between them all columns are taxels of the run.
        if taxels & taxels.wrapping_add(1) == 0 && are_equal(calibrated, filtered) {
            return self.add_all(filtered, run.peak, records);
        }
        let mut values = [0; WORD as usize];
        let (mut taxels, mut greatest) = (taxels, run.peak);
        for ((to, before), after) in values.iter_mut().zip(calibrated).zip(filtered) {
            if taxels & 1 == 1 {
                *to = *after;
                if before != after {
                    *to = pressure(*before, *after);
                    self.pressed = self.pressed.wrapping_add((*to - *after).into());
                    greatest = greatest.max(*to);
                }
            }
            taxels >>= 1;
        }
        self.add_all(values.get(..records.len()).unwrap_or(&values), greatest, records);
    }

    /// Adds values of which none is above `greatest`.
    fn add_all(&mut self, values: &[u16], greatest: u16, records: &[TaxelRecord]) {
        let records: &[RecordWords] = bytemuck::cast_slice(records);
        let together = if greatest <= COMMON { TOGETHER } else { 1 };
        if values.len() <= together {
            return self.add_few(values, records);
        }
        for (values, records) in values.chunks(together).zip(records.chunks(together)) {
            self.add_few(values, records);
        }
    }

    /// Adds values whose products have 31 bits together.
    #[inline(never)] // M0+: out of line
    fn add_few(&mut self, values: &[u16], records: &[RecordWords]) {
        let ((x, y), (z, u)) = (by_word::<2>(values, records), by_word::<3>(values, records));
        let (v, w) = by_word::<4>(values, records);
        for (to, more) in self.force.iter_mut().zip([x, y, z]) {
            *to = to.wrapping_add(more.into());
        }
        for (to, more) in self.moment.iter_mut().zip([u, v, w]) {
            *to = to.wrapping_add(more.into());
        }
    }

    /// Adds other sums.
    pub fn add(&mut self, more: &PressSums) {
        add_wide(&mut self.force, &more.force);
        add_wide(&mut self.moment, &more.moment);
        self.pressed = self.pressed.saturating_add(more.pressed);
    }
}

/// True if the filter has changed nothing. M0+: the library compares byte by byte.
fn are_equal(calibrated: &[u16], filtered: &[u16]) -> bool {
    calibrated.iter().zip(filtered).all(|(before, after)| before == after)
}

/// Pressure of a taxel, from its values before and after the filter: at least that after it.
fn pressure(before: u16, after: u16) -> u16 {
    let most = after.saturating_add(after / 16).saturating_add(MARGIN);
    if before <= most { before.max(after) } else { after }
}

/// A [`TaxelRecord`] in words: its halves are link and region, place, normal, arm.
type RecordWords = [u32; 5];

/// Sums of value times each of the two numbers in a word of the records, of 31 bits. M0+: two sums stay in
/// registers, three would not; and a word is read as fast as a half.
#[inline(never)]
fn by_word<const N: usize>(values: &[u16], records: &[RecordWords]) -> (i32, i32) {
    let mut sums = (0i32, 0i32);
    for (value, record) in values.iter().zip(records) {
        let (value, word) = (i32::from(*value), record[N]);
        sums.0 = sums.0.wrapping_add(value * low(word));
        sums.1 = sums.1.wrapping_add(value * high(word));
    }
    sums
}

/// The first of two numbers in a word.
const fn low(word: u32) -> i32 {
    word as i16 as i32
}

/// The second one.
const fn high(word: u32) -> i32 {
    word as i32 >> 16
}

fn add_wide(to: &mut [i64; 3], more: &[i64; 3]) {
    for (to, more) in to.iter_mut().zip(more) {
        *to = to.wrapping_add(*more);
    }
}
