//! The image that was sent last.

use super::encoder::Encoder;
use crate::condition::{Held, Image};
use crate::garment::Layout;
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
        let mut part = 0..0;
        for area in layout.areas() {
            let (columns, end) = (usize::from(area.columns), area.first_row.saturating_add(area.rows));
            let mut next = area.first_row;
            while let Some(first) = rows.next(next..end) {
                next = first + 1;
                while next < end && rows.next(next..next + 1).is_some() {
                    next += 1;
                }
                let of = |row: u16| usize::from(area.base) + usize::from(row - area.first_row) * columns;
                if of(first) != part.end {
                    self.tell(&mut encoder, image, alone, part)?;
                    part = of(first)..0;
                }
                part.end = of(next);
            }
        }
        self.tell(&mut encoder, image, alone, part)?;
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
    ) -> Option<()> {
        let now = image.values.get(part.clone()).unwrap_or(&[]);
        let last = self.values.get_mut(part.clone()).unwrap_or(&mut []);
        encoder.part(part.start, now, if alone { None } else { Some(last) })?;
        let taxels = now.len();
        if let (Some(last), Some(now)) = (last.get_mut(..taxels), now.get(..taxels)) {
            last.copy_from_slice(now);
        }
        self.sum = self.sum.wrapping_add(sum_of(part.start, now));
        Some(())
    }
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
