//! Reconstructs images from the differences that are sent.

use super::event::ImageNews;
use taxel_core::wire::{Frame, decode_image, image_sum};

/// Undecoded images after which a key frame is requested again.
const PATIENCE: u32 = 100;

#[derive(Debug, Default, Clone)]
pub(super) struct Picture {
    /// Frame number of `values`; none if they are invalid.
    frame: Option<u32>,
    values: Vec<u16>,
    next: Vec<u16>,
    /// Consecutive undecoded images.
    missed: u32,
}

impl Picture {
    /// Handles an image of `taxels` taxels.
    pub fn take(&mut self, frame: &Frame<'_>, taxels: usize) -> ImageNews {
        let news = self.decode(frame, taxels);
        if news == ImageNews::Whole {
            std::mem::swap(&mut self.values, &mut self.next);
            self.frame = Some(frame.frame);
            self.missed = 0;
        } else {
            // The board uses this image as the base of the next.
            self.frame = None;
            self.missed += 1;
        }
        news
    }

    fn decode(&mut self, frame: &Frame<'_>, taxels: usize) -> ImageNews {
        let known = frame.base.is_none() || (frame.base == self.frame && self.values.len() == taxels);
        if !known || taxels == 0 {
            return ImageNews::NoBase;
        }
        self.next.resize(taxels, 0);
        let base = frame.base.map(|_| self.values.as_slice());
        match decode_image(frame.data, base, &mut self.next) {
            Ok(()) if image_sum(&self.next) == frame.sum => ImageNews::Whole,
            _ => ImageNews::Wrong,
        }
    }

    /// True if a key frame is to be requested now.
    pub(crate) fn wants_key(&self) -> bool {
        self.missed % PATIENCE == 1
    }

    pub fn image(&self) -> Option<(u32, &[u16])> {
        self.frame.map(|frame| (frame, self.values.as_slice()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::format::Micros;
    use taxel_core::wire::encode_image;

    fn frame<'a>(number: u32, values: &[u16], base: Option<(u32, &[u16])>, data: &'a mut [u8]) -> Frame<'a> {
        let length = encode_image(values, base.map(|(_, base)| base), data).unwrap();
        let (sum, base) = (image_sum(values), base.map(|(number, _)| number));
        Frame { frame: number, time: Micros(0), base, sum, data: &data[..length] }
    }

    #[test]
    fn a_missing_base_asks_for_a_key_once() {
        let (a, b, c) = ([0, 7, 9], [0, 8, 9], [1, 8, 9]);
        let mut picture = Picture::default();
        let mut data = [0; 32];
        assert_eq!(picture.take(&frame(1, &a, None, &mut data), 3), ImageNews::Whole);
        assert_eq!(picture.take(&frame(2, &b, Some((1, &a)), &mut data), 3), ImageNews::Whole);
        assert_eq!(picture.image(), Some((2, &b[..])));
        // Frame 3 is lost.
        assert_eq!(picture.take(&frame(4, &c, Some((3, &b)), &mut data), 3), ImageNews::NoBase);
        assert!(picture.wants_key() && picture.image().is_none());
        assert_eq!(picture.take(&frame(5, &c, Some((4, &c)), &mut data), 3), ImageNews::NoBase);
        assert!(!picture.wants_key());
        let wrong = Frame { sum: 1, ..frame(6, &c, None, &mut data) };
        assert_eq!(picture.take(&wrong, 3), ImageNews::Wrong);
        assert_eq!(picture.take(&frame(7, &c, None, &mut data), 3), ImageNews::Whole);
        assert_eq!(picture.image(), Some((7, &c[..])));
    }
}
