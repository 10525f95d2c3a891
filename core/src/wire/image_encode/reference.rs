//! The reference: the image that was sent last.

use super::encoder::Encoder;
use crate::garment::Layout;
use crate::image::row_set::RowSet;
use crate::image::view::Image;
use bytemuck::{try_cast_slice, try_cast_slice_mut};
use core::ops::Range;

/// The image that was sent last, to which the next one is encoded as a difference. Only rows in which either
/// of them may hold something are read.
pub(crate) struct ImageReference<const TAXELS: usize> {
    values: [u16; TAXELS],
    /// Rows of `values` that may not be 0.
    rows: RowSet,
    /// [`image_sum`](crate::wire::image_sum) of `values`.
    sum: u32,
}

impl<const TAXELS: usize> ImageReference<TAXELS> {
    /// An image without pressure.
    pub const fn new() -> Self {
        ImageReference { values: [0; TAXELS], rows: RowSet::NONE, sum: 0 }
    }

    /// Resets it to an image without pressure: before another layout, and when an image was stored only in
    /// part.
    pub fn clear(&mut self) {
        self.values.fill(0);
        (self.rows, self.sum) = (RowSet::NONE, 0);
    }

    /// The checksum of the image.
    pub fn sum(&self) -> u32 {
        self.sum
    }

    /// Encodes `image` into `out`, `alone` or as a difference, and makes it the reference; returns the length
    /// of the code. `None` if there is no room; the reference then mixes two images.
    pub fn advance(
        &mut self,
        layout: &Layout,
        image: &Image<'_>,
        alone: bool,
        out: &mut [u8],
    ) -> Option<usize> {
        let room = out.len();
        let rows = image.rows.held().with(&self.rows);
        // A single taxel that keeps the reference does not end a run: in a panel of one column, a part must
        // not see what follows it.
        let narrow = layout.areas().iter().any(|area| area.columns == 1);
        let taxels = image.values.len().min(TAXELS);
        let mut step = BaseStep {
            encoder: Encoder::new(out),
            now: image.values.get(..taxels)?,
            kept: self.values.get_mut(..taxels)?,
            sum: 0,
            alone,
            narrow,
        };
        let mut part = 0..0;
        for area in layout.areas() {
            let (columns, end) = (usize::from(area.columns), area.first_row.saturating_add(area.rows));
            let of = |row: u16| usize::from(area.base) + usize::from(row - area.first_row) * columns;
            let mut next = area.first_row;
            while let Some(run) = rows.run(next..end) {
                next = run.end;
                if of(run.start) != part.end {
                    step.encode(part)?;
                    part = of(run.start)..0;
                }
                part.end = of(run.end);
            }
        }
        step.encode(part)?;
        (self.rows, self.sum) = (*image.rows.held(), step.sum);
        Some(room - step.encoder.room())
    }
}

/// Work space of [`ImageReference::advance`].
struct BaseStep<'a> {
    encoder: Encoder<'a>,
    now: &'a [u16],
    kept: &'a mut [u16],
    /// Checksum of the part that is stored so far.
    sum: u32,
    alone: bool,
    /// True if no part may see what follows it.
    narrow: bool,
}

impl BaseStep<'_> {
    /// Encodes and stores consecutive rows as one part: a run does not end where a row does.
    #[inline(never)] // M0+: out of line
    fn encode(&mut self, part: Range<usize>) -> Option<()> {
        if part.is_empty() {
            return Some(());
        }
        let end = if self.narrow { part.end } else { self.now.len() };
        let base = if self.alone { None } else { self.kept.get(..end) };
        self.encoder.part(part.clone(), self.now.get(..end)?, base)?;
        let now = self.now.get(part.clone())?;
        keep(self.kept.get_mut(part.clone())?, now);
        self.sum = self.sum.wrapping_add(sum_of(part.start, now));
        Some(())
    }
}

/// Copies taxels, in blocks if both slices are aligned to words.
fn keep(kept: &mut [u16], values: &[u16]) {
    let mut done = 0;
    if let (Ok(words), Ok(kept)) = (try_cast_slice(values), try_cast_slice_mut(kept)) {
        let (large, words) = words.as_chunks::<{ 2 * BLOCK }>();
        let (kept_large, kept) = kept.as_chunks_mut();
        large.iter().zip(kept_large).for_each(|(block, kept)| keep_block(kept, block));
        let (small, kept) = (words.first_chunk::<BLOCK>(), kept.first_chunk_mut());
        done = 4 * BLOCK * large.len();
        if let (Some(small), Some(kept)) = (small, kept) {
            keep_block(kept, small);
            done += 2 * BLOCK;
        }
    }
    if done < values.len()
        && let (Some(kept), Some(values)) = (kept.get_mut(done..values.len()), values.get(done..))
    {
        kept.copy_from_slice(values);
    }
}

/// Number of words of a small block: a row of sixteen taxels.
const BLOCK: usize = 8;

/// Copies a block by a few instructions that move many words each. Inlined into the loop, it would become a
/// call of `memcpy`, which takes twice as long.
#[inline(never)]
fn keep_block<const WORDS: usize>(kept: &mut [u32; WORDS], block: &[u32; WORDS]) {
    *kept = *block;
}

/// Returns the contribution of the taxels from number `start` on to [`image_sum`](crate::wire::image_sum).
///
/// The sum of the sums of all values up to each of `count` taxels is `sum (count - i) value`, and needs no
/// multiplication.
#[inline(never)]
fn sum_of(start: usize, values: &[u16]) -> u32 {
    let (mut plain, mut placed) = (0u32, 0u32);
    let mut add = |value: &u16| {
        plain = plain.wrapping_add((*value).into());
        placed = placed.wrapping_add(plain);
    };
    let (blocks, rest) = values.as_chunks::<16>();
    blocks.iter().for_each(|block| block.iter().for_each(&mut add));
    rest.iter().for_each(add);
    plain.wrapping_mul((start + values.len() + 1) as u32).wrapping_sub(placed)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::garment::Garment;
    use crate::image::rows::Rows;
    use crate::wire::{decode_image, image_sum};
    use std::vec;

    #[test]
    fn taxels_are_kept_and_summed_up_wherever_they_stand() {
        let values: [u16; 140] = core::array::from_fn(|i| (i * i * 77) as u16 | 1);
        for start in 0..5 {
            for end in start..values.len() {
                let part = &values[start..end];
                let (mut image, mut kept) = ([0; 141], [0; 141]);
                image[start..end].copy_from_slice(part);
                for at in [start, start + 1] {
                    keep(&mut kept[at..at + part.len()], part);
                    assert_eq!(&kept[at..at + part.len()], part);
                }
                assert_eq!(sum_of(start, part), image_sum(&image), "{start} {end}");
            }
        }
    }

    #[test]
    fn images_of_any_garment_come_back_and_are_kept() {
        let mut rng = fastrand::Rng::with_seed(5);
        for round in 0..300 {
            // In a tenth of the garments each panel has one column.
            let mut columns = |of: [u16; 5]| if round % 10 == 0 { 1 } else { of[rng.usize(..5)] };
            let all = [columns([1, 2, 7, 16, 33]), columns([1, 3, 8, 16, 20]), columns([1, 3, 8, 16, 20])];
            let mut garment = Garment::recorded(1 + rng.u16(..12), all[0]);
            for (name, columns) in ["b", "c"].into_iter().zip(&all[1..]) {
                let mut panel = garment.panels[0].clone();
                (panel.name, panel.rows) = (crate::format::Name::try_from(name).unwrap(), 1 + rng.u16(..12));
                panel.columns = *columns;
                garment.panels.push(panel).unwrap();
            }
            let layout = Layout::build(&garment, 2048, 4095).unwrap();
            let mut reference = ImageReference::<2048>::new();
            let (mut values, mut decoded) = (vec![0u16; layout.taxels()], vec![0u16; layout.taxels()]);
            for frame in 0..12 {
                let held = [0, 10, 50, 100][rng.usize(..4)];
                for area in layout.areas() {
                    for row in 0..area.rows {
                        let start = usize::from(area.base + row * area.columns);
                        let row = &mut values[start..][..area.columns.into()];
                        let is_held = rng.usize(..100) < held;
                        row.iter_mut().for_each(|value| *value = if is_held { rng.u16(..300) } else { 0 });
                    }
                }
                let rows = Rows::of(&layout, &values);
                let (image, alone) = (Image { values: &values, rows: &rows }, rng.bool());
                let mut code = vec![0; 4 * values.len() + 99];
                let length = reference.advance(&layout, &image, alone, &mut code).unwrap();
                let base = decoded.clone();
                decode_image(&code[..length], Some(&base[..]).filter(|_| !alone), &mut decoded).unwrap();
                assert_eq!(decoded, values, "round {round}, frame {frame}, alone: {alone}");
                let kept = (&reference.values[..values.len()], reference.sum());
                assert_eq!(kept, (&values[..], image_sum(&values)), "round {round}, frame {frame}");
            }
        }
    }
}
