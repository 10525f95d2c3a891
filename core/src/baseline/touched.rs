//! Places of the contacts, to be asked of many taxels.

use super::feedback::{Feedback, Pressed};
use crate::capacity::TAXELS;
use crate::fold::consecutive;
use crate::garment::Layout;
use core::ops::Range;

/// Words of a bit for each taxel, and one more, so that each of those has a next one.
const WORDS: usize = TAXELS.div_ceil(32) + 1;

/// A bit for each taxel within some taxels of a contact.
pub(crate) struct Touched {
    taxels: [u32; WORDS],
    /// True if it is none of those that were asked for.
    pub is_empty: bool,
}

impl Touched {
    /// Taxels within `beside` taxels of the contacts' rectangles, in the same panel. Those of rows without a
    /// taxel that is `asked` may be left out.
    #[inline(never)] // once in a frame, with much stack
    pub fn of<const CONTACTS: usize>(
        layout: &Layout,
        feedback: &Feedback<CONTACTS>,
        beside: u16,
        asked: &Range<usize>,
    ) -> Touched {
        let mut touched = Touched { taxels: [0; WORDS], is_empty: true };
        for Pressed { rect, .. } in feedback.home.iter().chain(&feedback.beyond) {
            let Some(area) = layout.areas().get(usize::from(rect.panel)) else { continue };
            let [left, top] = [rect.left, rect.top].map(|first| first.saturating_sub(beside));
            let right = rect.right.saturating_add(beside + 1).min(area.columns);
            let bottom = rect.bottom.saturating_add(beside + 1).min(area.rows);
            let columns = usize::from(area.columns);
            let [start, end] = [top, bottom].map(|row| usize::from(area.base) + usize::from(row) * columns);
            if end <= asked.start || asked.end <= start {
                continue;
            }
            touched.is_empty = false;
            let mut corner = start + usize::from(left);
            let mut count = right.saturating_sub(left);
            // As many columns at a time as a word has bits.
            while count > 0 {
                let bits = u32::MAX >> 32u16.saturating_sub(count);
                touched.mark(corner, bits, (bottom.saturating_sub(top), columns));
                (corner, count) = (corner + 32, count.saturating_sub(32));
            }
        }
        touched
    }

    /// Marks taxels from `first` on, by bits, in so many rows of a panel of so many columns.
    #[inline(never)] // M0+: own registers
    fn mark(&mut self, mut first: usize, bits: u32, (rows, columns): (u16, usize)) {
        for _ in 0..rows {
            let (word, bit) = (first / 32, first % 32);
            if let Some([word, next]) = self.taxels.get_mut(word..).and_then(|words| words.first_chunk_mut())
            {
                *word |= bits << bit;
                // In two steps: by 32 nothing can be shifted.
                *next |= bits >> 1 >> (31 - bit);
            }
            first += columns;
        }
    }

    /// All bits of each byte, of four, whose taxel is one of them.
    #[inline(never)] // own registers
    pub fn bytes(&self, taxels: &[u16; 4]) -> u32 {
        if let Some(first) = consecutive(taxels) {
            // Bits to the lowest bits of bytes, and these to bytes: no product reaches another one.
            return (self.four(first).wrapping_mul(0x0020_4081) & 0x0101_0101).wrapping_mul(0xFF);
        }
        let bytes = |taxel: &u16| if self.has((*taxel).into()) { 0xFF } else { 0 };
        taxels.iter().rev().fold(0, |all, taxel| all << 8 | bytes(taxel))
    }

    /// A bit for each of four taxels that follow each other.
    #[inline(always)]
    pub fn four(&self, first: usize) -> u32 {
        let (word, bit) = (first / 32, first % 32);
        let Some([word, next]) = self.taxels.get(word..).and_then(|words| words.first_chunk()) else {
            return 0;
        };
        // In two steps: by 32 nothing can be shifted.
        (word >> bit | next << 1 << (31 - bit)) & 0xF
    }

    /// True if a taxel is one of them.
    #[inline(always)]
    pub fn has(&self, taxel: usize) -> bool {
        self.taxels.get(taxel / 32).is_some_and(|word| word >> (taxel % 32) & 1 == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::{Garment, Rect};

    #[test]
    fn the_same_taxels_as_each_rectangle_holds() {
        // The last has more columns than a word has bits.
        for garment in [Garment::reference(), Garment::mat(), Garment::block(), Garment::recorded(8, 100)] {
            let layout = Layout::build(&garment, TAXELS, u16::MAX).unwrap();
            for (top, bottom, left, right, beside) in [
                (0, 0, 0, 0, 1),
                (2, 3, 4, 15, 1),
                (1, 3, 7, 9, 3),
                (3, 3, 15, 15, 3),
                (0, 3, 0, 15, 1),
                (1, 2, 3, 90, 1),
            ] {
                let rect = Rect { panel: layout.areas().len() as u8 - 1, top, bottom, left, right };
                let mut feedback = Feedback::<4>::new();
                feedback.home.push(Pressed { rect, peak: 1, slow: false }).unwrap();
                let touched = Touched::of(&layout, &feedback, beside, &(0..TAXELS));
                // The same of some taxels, if only they are asked for.
                for asked in [0..1, 3..40, layout.taxels() / 2..layout.taxels()] {
                    let of_some = Touched::of(&layout, &feedback, beside, &asked);
                    assert!(asked.clone().all(|taxel| of_some.has(taxel) == touched.has(taxel)), "{asked:?}");
                }
                for taxel in 0..layout.taxels() {
                    let place = layout.place(taxel).unwrap();
                    let want = rect.holds(place.panel, place.row, place.column, beside);
                    assert_eq!(touched.has(taxel), want, "{rect:?} {beside} {place:?}");
                }
                for first in 0..layout.taxels() as u16 - 3 {
                    // In a row, and not.
                    for taxels in [[0, 1, 2, 3], [0, 2, 3, 70]].map(|all| all.map(|at| first + at)) {
                        let want = taxels.map(|taxel| if touched.has(taxel.into()) { 0xFF } else { 0 });
                        assert_eq!(touched.bytes(&taxels).to_le_bytes(), want, "{rect:?} {taxels:?}");
                    }
                }
            }
        }
    }
}
