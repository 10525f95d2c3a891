//! The image that was sent last.

use super::encoder::Encoder;
use crate::condition::{Held, Image};
use crate::garment::Layout;
use bytemuck::{pod_align_to, pod_align_to_mut};
use core::ops::Range;

/// The image that was sent last, which the next one is told by its difference to. Only rows in which one of them may hold
/// something are looked at.
pub(crate) struct Reference<const TAXELS: usize> {
    values: [u16; TAXELS],
    /// Rows of `values` that may hold something.
    rows: Held,
    /// [`image_sum`](super::image_sum) of `values`.
    sum: u32,
}

impl<const TAXELS: usize> Reference<TAXELS> {
    /// An image without pressure.
    pub const fn new() -> Self {
        Reference { values: [0; TAXELS], rows: Held::NONE, sum: 0 }
    }

    /// Forgets it, for an image without pressure: before another layout, and when it was kept only in part.
    pub fn clear(&mut self) {
        self.values.fill(0);
        (self.rows, self.sum) = (Held::NONE, 0);
    }

    /// The checksum of the image.
    pub fn sum(&self) -> u32 {
        self.sum
    }

    /// Writes the code of `image` into `out`, `alone` or as the difference, and keeps it; the length of the code. `None`: no
    /// room, and what is kept is part of one image and part of another.
    pub fn advance(
        &mut self,
        layout: &Layout,
        image: &Image<'_>,
        alone: bool,
        out: &mut [u8],
    ) -> Option<usize> {
        let room = out.len();
        let mut encoder = Encoder::new(out);
        self.sum = 0;
        let rows = image.rows.held().with(&self.rows);
        // One taxel that keeps the reference does not end a run: there it must not be seen what follows a part.
        let narrow = layout.areas().iter().any(|area| area.columns == 1);
        let mut part = 0..0;
        for area in layout.areas() {
            let (columns, end) = (usize::from(area.columns), area.first_row.saturating_add(area.rows));
            let of = |row: u16| usize::from(area.base) + usize::from(row - area.first_row) * columns;
            let mut next = area.first_row;
            while let Some(run) = rows.run(next..end) {
                next = run.end;
                if of(run.start) != part.end {
                    self.tell(&mut encoder, image, alone, part, narrow)?;
                    part = of(run.start)..0;
                }
                part.end = of(run.end);
            }
        }
        self.tell(&mut encoder, image, alone, part, narrow)?;
        self.rows = *image.rows.held();
        Some(room - encoder.room())
    }

    /// Rows that follow each other, as one: a run does not end where a row does.
    fn tell(
        &mut self,
        encoder: &mut Encoder<'_>,
        image: &Image<'_>,
        alone: bool,
        part: Range<usize>,
        narrow: bool,
    ) -> Option<()> {
        let now = image.values.get(part.clone()).unwrap_or(&[]);
        let end = if narrow { part.end } else { TAXELS }.min(image.values.len()).min(TAXELS);
        let base = if alone { None } else { self.values.get(..end) };
        encoder.part(part.clone(), image.values.get(..end)?, base)?;
        let last = self.values.get_mut(part.clone()).unwrap_or(&mut []);
        keep(last, now);
        self.sum = self.sum.wrapping_add(sum_of(part.start, now));
        Some(())
    }
}

/// Copies taxels: many of them in blocks, where both stand on words.
fn keep(kept: &mut [u16], values: &[u16]) {
    /// From here on it pays.
    const MANY: usize = 256;
    let mut done = 0;
    if values.len() >= MANY
        && let (([], words, _), ([], kept_words, _)) = (pod_align_to(values), pod_align_to_mut(kept))
    {
        let blocks = words.as_chunks().0.iter().zip(kept_words.as_chunks_mut().0);
        blocks.for_each(|(block, kept)| {
            keep_block(kept, block);
            done += 2 * BLOCK;
        });
    }
    if let (Some(kept), Some(values)) = (kept.get_mut(done..values.len()), values.get(done..)) {
        kept.copy_from_slice(values);
    }
}

/// Words of a block.
const BLOCK: usize = 16;

/// By itself it is a few instructions that move many words each; of all blocks together a compiler would make a call of `memcpy`, which
/// takes twice as long.
#[inline(never)]
fn keep_block(kept: &mut [u32; BLOCK], block: &[u32; BLOCK]) {
    *kept = *block;
}

/// What taxels from number `start` on have in the [`image_sum`](super::image_sum).
///
/// The sum of the sums of all values up to each of `count` taxels holds `sum (count - i) value`, and costs no multiplication.
#[inline(never)]
fn sum_of(start: usize, values: &[u16]) -> u32 {
    let (mut plain, mut placed) = (0u32, 0u32);
    let mut add = |value: &u16| {
        plain = plain.wrapping_add((*value).into());
        placed = placed.wrapping_add(plain);
    };
    let (blocks, rest) = values.as_chunks::<8>();
    blocks.iter().for_each(|block| block.iter().for_each(&mut add));
    rest.iter().for_each(add);
    plain.wrapping_mul((start + values.len() + 1) as u32).wrapping_sub(placed)
}
