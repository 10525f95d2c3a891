//! The image that was sent last.

use super::encoder::Encoder;
use crate::condition::{Image, Rows};
use crate::garment::Layout;
use core::ops::Range;

/// The image that was sent last, which the next one is told by its difference to. Only rows in which one of them may hold
/// something are looked at.
pub(crate) struct Reference<const TAXELS: usize> {
    values: [u16; TAXELS],
    /// Rows of `values` that may hold something.
    rows: Rows,
    /// [`image_sum`](super::image_sum) of `values`.
    sum: u32,
}

impl<const TAXELS: usize> Reference<TAXELS> {
    /// An image without pressure.
    pub const fn new() -> Self {
        Reference { values: [0; TAXELS], rows: Rows::NONE, sum: 0 }
    }

    /// Forgets it, for an image without pressure: before another layout, and when it was kept only in part.
    pub fn clear(&mut self) {
        self.values.fill(0);
        (self.rows, self.sum) = (Rows::NONE, 0);
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
        let mut part = 0..0;
        for area in layout.areas() {
            for row in 0..area.rows {
                let number = area.first_row.saturating_add(row);
                if !image.rows.contains(number) && !self.rows.contains(number) {
                    continue;
                }
                let start = usize::from(area.base) + usize::from(row) * usize::from(area.columns);
                if start != part.end {
                    self.tell(&mut encoder, image, alone, part)?;
                    part = start..start;
                }
                part.end = start + usize::from(area.columns);
            }
        }
        self.tell(&mut encoder, image, alone, part)?;
        self.rows = *image.rows;
        self.sum = encoder.sum().wrapping_add(if alone { 0 } else { self.sum });
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
        Some(())
    }
}
