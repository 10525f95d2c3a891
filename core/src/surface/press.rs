//! Sums over the taxels of a contact: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be distinguished from an
//! impulse. What it cuts from a crest is part of the force: a taxel counts with its value before the filter,
//! unless that exceeds the filtered one by more than noise, which an impulse does.

use crate::contact::PressedRuns;
use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;

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

/// Pressure of a taxel, counts, and its record.
pub(super) type PressedTaxel<'a> = (u32, &'a RecordWords);

/// Most taxels that are gathered before they are summed up: those of a small contact.
pub(super) const BATCH: usize = 64;

/// The record of no taxel.
pub(super) const NO_RECORD: &RecordWords = &[0; 5];

/// Force and moment of taxels on their link: sums over values in counts, and records in units of 2^-14.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressSums {
    /// Sums of value times normal, and of value times arm, of taxels that press `held` counts together: sums
    /// of 64 bits take longer than a taxel, and most contacts need none.
    near: [i32; 6],
    held: u32,
    /// Such sums of all other taxels, which press `settled` counts.
    wide: [i64; 6],
    settled: u32,
}

impl PressSums {
    /// Nothing presses.
    pub const NONE: PressSums = PressSums { near: [0; 6], held: 0, wide: [0; 6], settled: 0 };

    /// Adds the taxels of runs; `batch` is room to work in.
    #[inline(never)] // M0+: own registers
    pub fn press<'a>(
        &mut self,
        image: &PressedImage<'a>,
        pressed: &PressedRuns<'_>,
        batch: &mut [PressedTaxel<'a>; BATCH],
    ) {
        let (mut count, mut held) = (0, 0);
        // Of one length, so that one check of a run is that of all.
        let all = image.before.len().min(image.after.len()).min(image.records.len());
        let (Some(before), Some(after), Some(records)) =
            (image.before.get(..all), image.after.get(..all), image.records.get(..all))
        else {
            return;
        };
        for (first, run) in pressed.each() {
            let range = first..first + usize::from(run.width());
            let (Some(before), Some(after), Some(records)) =
                (before.get(range.clone()), after.get(range.clone()), records.get(range))
            else {
                break;
            };
            let slots = batch.get_mut(count..).unwrap_or_default();
            let (taxels, sum) = if run.is_whole() {
                gather(slots, before, after, records)
            } else {
                gather_apart(slots, before, after, records, run.rebased())
            };
            if held + sum > TOGETHER || count + taxels > BATCH - WORD as usize {
                let (gathered, last) = batch.split_at_checked(count).unwrap_or_default();
                self.add_batch(gathered, held);
                self.add_run(last.get(..taxels).unwrap_or(last), sum);
                (count, held) = (0, 0);
            } else {
                (count, held) = (count + taxels, held + sum);
            }
        }
        self.add_batch(batch.get(..count).unwrap_or(batch), held);
    }

    /// Adds taxels that press `sum` counts together.
    #[inline(never)] // seldom
    fn add_run(&mut self, taxels: &[PressedTaxel<'_>], sum: u32) {
        if sum <= TOGETHER {
            return self.add_batch(taxels, sum);
        }
        for (value, record) in taxels {
            self.add_batch(&[(*value, record)], *value);
        }
    }

    /// Adds taxels that press `held` counts together, at most [`TOGETHER`].
    #[inline(never)] // M0+: own registers
    fn add_batch(&mut self, batch: &[PressedTaxel<'_>], held: u32) {
        self.make_room(held);
        self.held += held;
        let [x, y, z, u, v, w] = &mut self.near;
        // M0+: three sums at a time stay in registers.
        for (value, [_, _, xy, z_, _]) in batch {
            let value = *value as i32;
            *x = x.wrapping_add(value.wrapping_mul(low(*xy)));
            *y = y.wrapping_add(value.wrapping_mul(high(*xy)));
            *z = z.wrapping_add(value.wrapping_mul(low(*z_)));
        }
        for (value, [.., u_, vw]) in batch {
            let value = *value as i32;
            *u = u.wrapping_add(value.wrapping_mul(high(*u_)));
            *v = v.wrapping_add(value.wrapping_mul(low(*vw)));
            *w = w.wrapping_add(value.wrapping_mul(high(*vw)));
        }
    }

    /// Makes room for values that are at most `most` together, at most [`TOGETHER`].
    #[inline(always)]
    fn make_room(&mut self, most: u32) {
        if self.held + most > TOGETHER {
            self.settle(self.near, self.held);
            (self.near, self.held) = ([0; 6], 0);
        }
    }

    /// Settles sums of taxels that press `held` counts together.
    #[inline(never)] // M0+: out of line
    fn settle(&mut self, near: [i32; 6], held: u32) {
        add_near(&mut self.wide, &near);
        self.settled += held;
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

/// The lower half of a word, signed.
const fn low(word: u32) -> i32 {
    word as i16 as i32
}

/// The upper half of a word, signed.
const fn high(word: u32) -> i32 {
    word as i32 >> 16
}

/// Gathers the taxels of a run; returns their number and the sum of their values.
#[inline(always)]
fn gather<'a>(
    slots: &mut [PressedTaxel<'a>],
    before: &[u16],
    after: &[u16],
    records: &'a [RecordWords],
) -> (usize, u32) {
    let mut sum = 0;
    for (((slot, before), after), record) in slots.iter_mut().zip(before).zip(after).zip(records) {
        let value = pressure((*before).into(), (*after).into());
        sum += value;
        *slot = (value, record);
    }
    (records.len(), sum)
}

/// Gathers those of some taxels whose bits are set.
#[inline(never)] // few runs have gaps
fn gather_apart<'a>(
    slots: &mut [PressedTaxel<'a>],
    before: &[u16],
    after: &[u16],
    records: &'a [RecordWords],
    mut taxels: u32,
) -> (usize, u32) {
    let (mut slots, mut count, mut sum) = (slots.iter_mut(), 0, 0);
    for ((before, after), record) in before.iter().zip(after).zip(records) {
        if taxels & 1 == 1
            && let Some(slot) = slots.next()
        {
            let value = pressure((*before).into(), (*after).into());
            (count, sum) = (count + 1, sum + value);
            *slot = (value, record);
        }
        taxels >>= 1;
    }
    (count, sum)
}

/// Pressure of a taxel, from its values before and after the filter: at least that after it.
#[inline(always)]
fn pressure(before: u32, after: u32) -> u32 {
    // Most taxels are left as they are.
    if before == after { after } else { uncut(before, after) }
}

/// Pressure of a taxel that the filter has changed.
#[inline(never)] // seldom
fn uncut(before: u32, after: u32) -> u32 {
    let most = after + after / 16 + u32::from(MARGIN);
    if before <= most { before.max(after) } else { after }
}

fn add_near(to: &mut [i64; 6], near: &[i32; 6]) {
    for (to, near) in to.iter_mut().zip(near) {
        *to = to.wrapping_add(i64::from(*near));
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::garment::{Garment, Layout};
    use crate::segment::run::Run;
    use crate::segment::sums::RunSums;
    use std::vec::Vec;

    #[test]
    fn sums_are_exact_however_strongly_taxels_press() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 8) % end
        };
        let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
        let area = &layout.areas()[0];
        let columns = usize::from(area.columns);
        for round in 0..500 {
            let most = [30, 4096, 0x1_0000, 0x1_0000][round % 4];
            let after: Vec<u16> = (0..layout.taxels()).map(|_| next(most) as u16).collect();
            // As they are, cut, or an impulse.
            let mut before =
                |after: &u16| [*after, after.saturating_add(next(200) as u16), !0][next(3) as usize];
            let before: Vec<u16> = after.iter().map(&mut before).collect();
            // Halves at their ends, or any.
            let mut half = || [0x8000, 0x7FFF, next(1 << 16)][next(3) as usize];
            let records: Vec<RecordWords> =
                after.iter().map(|_| core::array::from_fn(|_| half() << 16 | half())).collect();
            let rows = 1 + next(area.rows.into()) as u16;
            let run = |row: u16| {
                // Whole ones, and some with gaps.
                let (left, right) = (next(20) as u16, 20 + next(12) as u16);
                let ends = 1 << left | 1 << right;
                let between = u32::MAX << left & u32::MAX >> (31 - right);
                let taxels =
                    if next(2) == 0 { between } else { between & (next(1 << 24) << 8 | next(256)) | ends };
                let area = taxels.count_ones() as u16;
                Run { taxels, row, label: 0, left, right, area, peak: 0, sums: RunSums::NONE }
            };
            let runs: Vec<Run> = (0..rows).map(run).collect();
            let image = PressedImage { before: &before, after: &after, records: &records };
            let pressed = PressedRuns { contact: 0, panel: 0, area, runs: &runs };
            let (mut sums, mut batch) = (PressSums::NONE, [(0, NO_RECORD); BATCH]);
            sums.press(&image, &pressed, &mut batch);
            let (mut want, mut total) = ([0i64; 6], 0);
            let of = |run: &Run| (0..columns).filter(|at| run.taxels >> at & 1 == 1).collect::<Vec<_>>();
            for taxel in
                runs.iter().flat_map(|run| of(run).into_iter().map(|at| usize::from(run.row) * columns + at))
            {
                let (before, after) = (i64::from(before[taxel]), i64::from(after[taxel]));
                let is_cut = before > after && before <= after + after / 16 + i64::from(MARGIN);
                let value = if is_cut { before } else { after };
                total += value;
                let halves = records[taxel][2..].iter().flat_map(|word| [*word as i16, (word >> 16) as i16]);
                want.iter_mut().zip(halves).for_each(|(sum, half)| *sum += value * i64::from(half));
            }
            assert_eq!(sums.sums().as_flattened(), want);
            assert_eq!(i64::from(sums.pressed()), total);
        }
    }

    #[test]
    fn what_presses_together_fits_in_32_bits() {
        for half in [i16::MIN, i16::MAX] {
            assert!(i32::try_from(i64::from(TOGETHER) * i64::from(half)).is_ok());
        }
    }
}
