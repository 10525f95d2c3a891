//! Sums over the taxels of a contact: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be told from an impulse. What
//! it cuts from a crest is part of the force: a taxel counts with its value before the filter, unless that
//! exceeds the filtered one by more than noise, which an impulse does.

use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;
use crate::segment::run::Run;

/// Most that taxels may press together so that their products fit in 32 bits: 65,535 * 2^15 < 2^31.
const TOGETHER: u32 = u16::MAX as u32;

/// A frame's values before and after the filter, and the records of its taxels, by taxel number.
pub(super) struct PressedImage<'a> {
    pub before: &'a [u16],
    pub after: &'a [u16],
    pub records: &'a [RecordWords],
}

/// A [`TaxelRecord`](super::TaxelRecord) in words: its halves are link and region, place, normal, arm.
pub(super) type RecordWords = [u32; 5];

/// What taxels press on their link: sums over values in counts, and records in units of 2^-14.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressSums {
    /// Sums of value times normal, and of value times arm, of taxels that press `held` counts together: sums
    /// of 64 bits take longer than a taxel, and most contacts need none.
    near: [i32; 6],
    held: u32,
    /// The same of all other taxels, which press `settled` counts.
    wide: [i64; 6],
    settled: u32,
}

impl PressSums {
    /// Nothing presses.
    pub const NONE: PressSums = PressSums { near: [0; 6], held: 0, wide: [0; 6], settled: 0 };

    /// Adds the taxels of a run whose first one is number `first`.
    #[inline(never)] // M0+: own registers
    pub fn press(&mut self, image: &PressedImage<'_>, first: usize, run: &Run) {
        let range = first..first + usize::from(run.right - run.left) + 1;
        let Some(before) = image.before.get(range.clone()) else { return };
        let Some(after) = image.after.get(range.clone()) else { return };
        let Some(records) = image.records.get(range) else { return };
        let (taxels, total) = (run.rebased(), run.sums.s0);
        let most = most_pressed(total);
        // Without a gap between them all columns are taxels of the run.
        if most > TOGETHER || taxels & taxels.wrapping_add(1) != 0 {
            return self.press_apart(before, after, records, taxels);
        }
        self.make_room(most);
        self.press_all(before, after, records, total);
    }

    /// Adds those of some taxels whose bits are set.
    #[inline(never)] // seldom
    fn press_apart(&mut self, before: &[u16], after: &[u16], records: &[RecordWords], mut taxels: u32) {
        let (mut values, mut total) = ([[0; WORD as usize]; 2], 0);
        let [to_before, to_after] = &mut values;
        for (((to_before, to_after), before), after) in
            to_before.iter_mut().zip(to_after).zip(before).zip(after)
        {
            if taxels & 1 == 1 {
                (*to_before, *to_after) = (*before, *after);
                total += u32::from(*after);
            }
            taxels >>= 1;
        }
        let [before, after] = values.each_ref().map(|values| values.get(..records.len()).unwrap_or(values));
        if most_pressed(total) <= TOGETHER {
            self.make_room(most_pressed(total));
            return self.press_all(before, after, records, total);
        }
        for ((before, after), record) in before.iter().zip(after).zip(records) {
            self.press_alone(*before, *after, record);
        }
    }

    /// Adds a taxel of those that press too much together.
    #[inline(never)] // seldom
    fn press_alone(&mut self, before: u16, after: u16, record: &RecordWords) {
        self.make_room(TOGETHER);
        let mut pressed = after.into();
        self.add(&[before], &[after], &[*record], &mut pressed);
        self.held += pressed;
    }

    /// Adds taxels for which there is room, whose values after the filter are `total` together.
    #[inline(always)] // M0+: a call takes as long as two taxels
    fn press_all(&mut self, before: &[u16], after: &[u16], records: &[RecordWords], total: u32) {
        let mut pressed = total;
        let [(before, last_before), (after, last_after)] = [before, after].map(|values| values.as_chunks());
        let (records, last_record) = records.as_chunks();
        for ((before, after), records) in before.iter().zip(after).zip(records) {
            self.add::<2>(before, after, records, &mut pressed);
        }
        if let ([before], [after], [record]) = (last_before, last_after, last_record) {
            self.add(&[*before], &[*after], &[*record], &mut pressed);
        }
        self.held += pressed;
    }

    /// Adds some taxels, and to `pressed` what the filter has cut from them.
    #[inline(always)]
    fn add<const N: usize>(
        &mut self,
        before: &[u16; N],
        after: &[u16; N],
        records: &[RecordWords; N],
        pressed: &mut u32,
    ) {
        let mut values = after.map(i32::from);
        for ((value, before), after) in values.iter_mut().zip(before).zip(after) {
            if before != after {
                *value = pressure(*before, *after).into();
                *pressed += value.unsigned_abs() - u32::from(*after);
            }
        }
        let [x, y, z, u, v, w] = &mut self.near;
        for (word, [low, high]) in [[x, y], [z, u], [v, w]].into_iter().enumerate() {
            for (value, record) in values.iter().zip(records) {
                let word = record[2 + word];
                *low = low.wrapping_add(value * i32::from(word as i16));
                *high = high.wrapping_add(value * (word as i32 >> 16));
            }
        }
    }

    /// Makes room for values that are at most `most` together, at most [`TOGETHER`].
    #[inline(always)]
    fn make_room(&mut self, most: u32) {
        if self.held + most > TOGETHER {
            self.settle();
        }
    }

    /// Settles all that is held.
    #[inline(never)] // M0+: out of line
    fn settle(&mut self) {
        add_near(&mut self.wide, &core::mem::take(&mut self.near));
        self.settled += core::mem::take(&mut self.held);
    }

    /// Sum of the values.
    pub fn pressed(&self) -> u32 {
        self.settled + self.held
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
        if more.settled > 0 {
            self.wide.iter_mut().zip(more.wide).for_each(|(to, more)| *to = to.wrapping_add(more));
            self.settled += more.settled;
        }
        self.make_room(more.held);
        self.held += more.held;
        self.near.iter_mut().zip(more.near).for_each(|(to, more)| *to = to.wrapping_add(more));
    }
}

/// The most that taxels of a run press whose values after the filter are `total` together.
const fn most_pressed(total: u32) -> u32 {
    total + total / 16 + WORD as u32 * MARGIN as u32
}

/// Pressure of a taxel, from its values before and after the filter: at least that after it.
#[inline(never)] // seldom
fn pressure(before: u16, after: u16) -> u16 {
    let most = after.saturating_add(after / 16).saturating_add(MARGIN);
    if before <= most { before.max(after) } else { after }
}

fn add_near(to: &mut [i64; 6], near: &[i32; 6]) {
    for (to, near) in to.iter_mut().zip(near) {
        *to = to.wrapping_add(i64::from(*near));
    }
}
