//! Sums over the taxels of a contact: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be told from an impulse. What
//! it cuts from a crest is part of the force: a taxel counts with its value before the filter, unless that
//! exceeds the filtered one by more than noise, which an impulse does.

use super::taxel::TaxelRecord;
use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;
use crate::segment::run::Run;
use core::ops::Range;

/// Most that taxels may press together so that their products fit in 32 bits: 65,535 * 2^15 < 2^31.
const TOGETHER: u32 = u16::MAX as u32;

/// A frame's values before and after the filter, and the records of its taxels, by taxel number.
pub(super) struct PressedImage<'a> {
    before: &'a [u16],
    after: &'a [u16],
    /// The same values, two at a time; none if they are not aligned to words.
    pairs: [&'a [u32]; 2],
    records: &'a [RecordWords],
}

impl<'a> PressedImage<'a> {
    pub fn new(images: [&'a [u16]; 2], records: &'a [TaxelRecord]) -> PressedImage<'a> {
        let [before, after] = images;
        let pairs = images.map(|values| bytemuck::try_cast_slice(values).unwrap_or(&[]));
        PressedImage { before, after, pairs, records: bytemuck::cast_slice(records) }
    }

    /// True if the filter has changed nothing in the pairs that hold these taxels. May be false without them.
    #[inline(always)]
    fn are_equal(&self, taxels: &Range<usize>) -> bool {
        let pairs = taxels.start / 2..taxels.end.div_ceil(2);
        let [before, after] = self.pairs;
        match (before.get(pairs.clone()), after.get(pairs)) {
            (Some(before), Some(after)) => before.iter().zip(after).all(|(before, after)| before == after),
            _ => false,
        }
    }
}

/// What taxels press on their link: sums over values in counts, and records in units of 2^-14.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressSums {
    /// Sums of value times normal, and of value times arm, without `near`.
    wide: [i64; 6],
    /// True if one of these is not 0.
    is_wide: bool,
    /// Sum of the values.
    pub pressed: u32,
    /// What is yet to be added to the wide sums, of taxels that press `held` counts together: a sum of 64 bits
    /// takes longer than a taxel, and most contacts need none.
    near: [i32; 6],
    held: u32,
}

impl PressSums {
    /// Nothing presses.
    pub const NONE: PressSums = PressSums { wide: [0; 6], is_wide: false, pressed: 0, near: [0; 6], held: 0 };

    /// Adds the taxels of a run whose first one is number `first`.
    #[inline(never)] // M0+: own registers
    pub fn press(&mut self, image: &PressedImage<'_>, first: usize, run: &Run) {
        let range = first..first + usize::from(run.right - run.left) + 1;
        let (taxels, total) = (run.rebased(), run.sums.s0);
        // Without a gap between them all columns are taxels of the run.
        let is_whole = taxels & taxels.wrapping_add(1) == 0;
        if !is_whole || total > TOGETHER || !image.are_equal(&range) {
            return self.press_apart(image, range, run);
        }
        let Some(values) = image.after.get(range.clone()) else { return };
        let Some(records) = image.records.get(range) else { return };
        self.hold(total);
        self.add(values, records);
    }

    /// Adds the taxels of any run.
    #[inline(never)] // seldom
    fn press_apart(&mut self, image: &PressedImage<'_>, range: Range<usize>, run: &Run) {
        let Some(before) = image.before.get(range.clone()) else { return };
        let Some(after) = image.after.get(range.clone()) else { return };
        let Some(records) = image.records.get(range) else { return };
        let mut values = [0; WORD as usize];
        let (mut taxels, mut total) = (run.rebased(), run.sums.s0);
        for ((to, before), after) in values.iter_mut().zip(before).zip(after) {
            if taxels & 1 == 1 {
                *to = *after;
                if before != after {
                    *to = pressure(*before, *after);
                    total += u32::from(*to - *after);
                }
            }
            taxels >>= 1;
        }
        if total <= TOGETHER {
            self.hold(total);
            return self.add(&values, records);
        }
        for (value, record) in values.iter().zip(records) {
            self.press_alone(*value, record);
        }
    }

    /// Adds a taxel of those that press too much together.
    #[inline(never)] // seldom
    fn press_alone(&mut self, value: u16, record: &RecordWords) {
        self.hold(value.into());
        self.add(&[value], &[*record]);
    }

    /// Makes room for values that are `total` together, at most [`TOGETHER`].
    #[inline(always)]
    fn hold(&mut self, total: u32) {
        self.pressed = self.pressed.wrapping_add(total);
        self.held += total;
        if self.held > TOGETHER {
            self.settle();
            self.held = total;
        }
    }

    /// Adds as many values as there are records.
    #[inline(always)] // M0+: a call takes as long as two taxels
    fn add(&mut self, values: &[u16], records: &[RecordWords]) {
        let [x, y, z, u, v, w] = &mut self.near;
        add_pair([x, y], by_word::<2>(values, records));
        add_pair([z, u], by_word::<3>(values, records));
        add_pair([v, w], by_word::<4>(values, records));
    }

    /// Adds what is yet to be added.
    #[inline(never)] // M0+: out of line
    fn settle(&mut self) {
        add_near(&mut self.wide, &core::mem::take(&mut self.near));
        self.is_wide = true;
    }

    /// Sums of value times normal, and of value times arm.
    fn sums(&self) -> [[i64; 3]; 2] {
        let mut wide = self.wide;
        add_near(&mut wide, &self.near);
        let [x, y, z, u, v, w] = wide;
        [[x, y, z], [u, v, w]]
    }

    /// Sum of value times normal.
    pub fn force(&self) -> [i64; 3] {
        let [force, _] = self.sums();
        force
    }

    /// Sum of value times arm.
    pub fn moment(&self) -> [i64; 3] {
        let [_, moment] = self.sums();
        moment
    }

    /// Adds other sums.
    pub fn add_all(&mut self, more: &PressSums) {
        add_near(&mut self.wide, &more.near);
        if more.is_wide {
            self.wide.iter_mut().zip(more.wide).for_each(|(to, more)| *to = to.wrapping_add(more));
        }
        self.is_wide = true;
        self.pressed = self.pressed.saturating_add(more.pressed);
    }
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

fn add_near(to: &mut [i64; 6], near: &[i32; 6]) {
    for (to, near) in to.iter_mut().zip(near) {
        *to = to.wrapping_add(i64::from(*near));
    }
}
