//! Images at even times: at each the last that there was.

use std::num::NonZeroU16;

/// Which rows an image stands in.
#[derive(Debug)]
pub struct Sampler {
    fps: u64,
    began_us: Option<u64>,
    /// The next row.
    row: u64,
}

impl Sampler {
    /// So many rows a second, the first at the first image.
    pub fn new(fps: NonZeroU16) -> Sampler {
        Sampler { fps: fps.get().into(), began_us: None, row: 0 }
    }

    /// The rows whose time has passed at `now_us`, or comes just then where `last`: what was before it stands in them.
    pub fn passed(&mut self, now_us: u64, last: bool) -> std::ops::Range<u64> {
        let began = *self.began_us.get_or_insert(now_us);
        let passed = now_us.saturating_sub(began) * self.fps;
        // Row n is at n / fps: those below `passed` are over, the one at `passed` is this image's.
        let end = if last { passed / 1_000_000 + 1 } else { passed.div_ceil(1_000_000) };
        let rows = self.row..end.max(self.row);
        self.row = rows.end;
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_the_last_image_at_its_time() {
        let mut sampler = Sampler::new(NonZeroU16::new(100).unwrap());
        assert_eq!(sampler.passed(5_000, false), 0..0);
        assert_eq!(sampler.passed(5_001, false), 0..1, "the first image stands in the first row");
        assert_eq!(sampler.passed(15_000, false), 1..1, "the image of just then is its row's");
        assert_eq!(sampler.passed(36_000, false), 1..4);
        assert_eq!(sampler.passed(45_000, true), 4..5, "the last image ends the episode");
        assert_eq!(sampler.passed(3, false), 5..5, "time that went back gives nothing");
    }
}
