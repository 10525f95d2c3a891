//! End of the scale of pressure: it fits the first touch, and grows where a touch goes beyond it, as on the page
//! (`follow.js`).

use crate::palette::{ENDS, START, end_for};

/// The scale, whose end keys may set.
#[derive(Debug, Clone, Copy)]
pub struct PressureScale {
    top: u16,
    /// Something has touched.
    fits: bool,
    /// A key has set the end.
    is_set: bool,
}

impl PressureScale {
    /// The scale before the first touch.
    pub fn new() -> PressureScale {
        PressureScale { top: START, fits: false, is_set: false }
    }

    /// Returns its end, counts.
    pub fn top(self) -> u16 {
        self.top
    }

    /// Follows an image; nothing touches below `low` counts.
    pub fn follow(&mut self, image: &[u16], low: u16) {
        let greatest = image.iter().copied().max().unwrap_or(0);
        if self.is_set || greatest < low {
            return;
        }
        let end = end_for(greatest);
        self.top = if self.fits { end.max(self.top) } else { end };
        self.fits = true;
    }

    /// Doubles or halves the end, which then stays.
    pub fn zoom(&mut self, up: bool) {
        self.top = if up { self.top.saturating_mul(2) } else { self.top / 2 }.clamp(ENDS[0], ENDS[1]);
        self.is_set = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_fits_the_first_touch_and_then_only_grows_unless_a_key_sets_it() {
        let mut scale = PressureScale::new();
        let mut after = |values: [u16; 2]| {
            scale.follow(&values, 10);
            scale.top()
        };
        assert_eq!([after([0, 9]), after([0, 90]), after([0, 12]), after([250, 0])], [START, 100, 100, 400]);
        scale.zoom(false);
        scale.follow(&[3_000], 10);
        assert_eq!(scale.top(), 200);
    }
}
