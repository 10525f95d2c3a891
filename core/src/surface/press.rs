//! Sums over the taxels of a contact: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be told from an impulse. What
//! it cuts from a crest is part of the force: a taxel counts with its value before the filter, unless that
//! exceeds the filtered one by more than noise, which an impulse does.

use super::taxel::TaxelRecord;
use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;
use crate::segment::run::Run;

/// Most that taxels may press together so that their products fit in 32 bits: 65,535 * 2^15 < 2^31.
const TOGETHER: u32 = u16::MAX as u32;

/// What taxels press on their link: sums over values in counts, and records in units of 2^-14.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressSums {
    /// Sum of value times normal, and of value times arm, without `near`.
    force: [i64; 3],
    moment: [i64; 3],
    /// Sum of the values.
    pub pressed: u32,
    /// What is yet to be added to force and moment, of taxels that press `held` counts together: a sum of 64
    /// bits takes longer than a taxel, and most contacts need one.
    near: [i32; 6],
    held: u32,
}

impl PressSums {
    /// Nothing presses.
    pub const NONE: PressSums =
        PressSums { force: [0; 3], moment: [0; 3], pressed: 0, near: [0; 6], held: 0 };

    /// Adds the taxels of a run, whose values before and after the filter are those of the columns from its
    /// first to its last one, as are the records.
    #[inline(never)] // M0+: out of line
    pub fn press(&mut self, values: (&[u16], &[u16]), run: &Run, records: &[TaxelRecord]) {
        let (taxels, total) = (run.rebased(), run.sums.s0);
        // Without a gap between them all columns are taxels of the run.
        let is_whole = taxels & taxels.wrapping_add(1) == 0;
        if is_whole && total <= TOGETHER && are_equal(values.0, values.1) {
            return self.add(values.1, total, bytemuck::cast_slice(records));
        }
        self.press_apart(values, run, records);
    }

    /// Adds the taxels of any run.
    #[inline(never)] // seldom
    fn press_apart(&mut self, (calibrated, filtered): (&[u16], &[u16]), run: &Run, records: &[TaxelRecord]) {
        let mut values = [0; WORD as usize];
        let (mut taxels, mut total) = (run.rebased(), run.sums.s0);
        for ((to, before), after) in values.iter_mut().zip(calibrated).zip(filtered) {
            if taxels & 1 == 1 {
                *to = *after;
                if before != after {
                    *to = pressure(*before, *after);
                    total += u32::from(*to - *after);
                }
            }
            taxels >>= 1;
        }
        let records: &[RecordWords] = bytemuck::cast_slice(records);
        if total <= TOGETHER {
            return self.add(values.get(..records.len()).unwrap_or(&values), total, records);
        }
        for (value, record) in values.iter().zip(records) {
            self.add(&[*value], (*value).into(), &[*record]);
        }
    }

    /// Adds values that are `total` together, at most [`TOGETHER`].
    #[inline(never)] // M0+: own registers
    fn add(&mut self, values: &[u16], total: u32, records: &[RecordWords]) {
        self.pressed = self.pressed.wrapping_add(total);
        self.held += total;
        if self.held > TOGETHER {
            self.settle();
            self.held = total;
        }
        let [x, y, z, u, v, w] = &mut self.near;
        add_pair([x, y], by_word::<2>(values, records));
        add_pair([z, u], by_word::<3>(values, records));
        add_pair([v, w], by_word::<4>(values, records));
    }

    /// Adds what is yet to be added.
    #[inline(never)] // M0+: out of line
    fn settle(&mut self) {
        let [x, y, z, u, v, w] = core::mem::take(&mut self.near);
        add_wide(&mut self.force, &[x, y, z].map(i64::from));
        add_wide(&mut self.moment, &[u, v, w].map(i64::from));
    }

    /// Sum of value times normal.
    pub fn force(&self) -> [i64; 3] {
        let [x, y, z, ..] = self.near;
        let mut force = self.force;
        add_wide(&mut force, &[x, y, z].map(i64::from));
        force
    }

    /// Sum of value times arm.
    pub fn moment(&self) -> [i64; 3] {
        let [.., u, v, w] = self.near;
        let mut moment = self.moment;
        add_wide(&mut moment, &[u, v, w].map(i64::from));
        moment
    }

    /// Adds other sums.
    pub fn add_all(&mut self, more: &PressSums) {
        add_wide(&mut self.force, &more.force());
        add_wide(&mut self.moment, &more.moment());
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

/// Sums of value times each of the two numbers in a word of the records, of 32 bits. M0+: two sums stay in
/// registers, three would not; and a word is read as fast as a half.
#[inline(always)]
fn by_word<const N: usize>(values: &[u16], records: &[RecordWords]) -> (i32, i32) {
    let mut sums = (0i32, 0i32);
    for (value, record) in values.iter().zip(records) {
        let (value, word) = (i32::from(*value), record[N]);
        sums.0 = sums.0.wrapping_add(value * low(word));
        sums.1 = sums.1.wrapping_add(value * high(word));
    }
    sums
}

#[inline(always)]
fn add_pair([a, b]: [&mut i32; 2], (more_a, more_b): (i32, i32)) {
    (*a, *b) = (a.wrapping_add(more_a), b.wrapping_add(more_b));
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
