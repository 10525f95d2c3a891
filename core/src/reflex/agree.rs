//! Number of taxels that must agree before a reflex begins.

use super::spot::Spot;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Number of taxels beyond the limit that a reflex needs.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Agree {
    /// One: fastest, but every impulse on a taxel is a reflex.
    One,
    /// Two of one panel within the time of a frame. In the same frame they are at most two rows and two
    /// columns apart, in different frames neighbours.
    ///
    /// Impulses that hit a taxel in one frame, and neither it nor its eight neighbours in the next, never
    /// cause this if no two of a frame are that near each other.
    #[default]
    Two,
}

/// Capacity of [`Recent`]: as many taxels as a frame and a half has with impulses on a hundredth of 2,048.
const SEEN: usize = 32;
/// Largest distance in rows and in columns of two taxels that agree, in one frame and across two.
const NEAR: u16 = 2;
const NEXT: u16 = 1;

/// A taxel that was beyond its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct SeenTaxel {
    taxel: u16,
    spot: Spot,
    /// Number of the sub-field, counted over all frames.
    field: u32,
}

/// Taxels that were beyond their limits within the time of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Recent {
    seen: Vec<SeenTaxel, SEEN>,
    oldest: u8,
    /// Number of the present sub-field, counted over all frames.
    field: u32,
}

impl Recent {
    /// No taxels.
    pub const fn new() -> Recent {
        Recent { seen: Vec::new(), oldest: 0, field: 0 }
    }

    /// Forgets all taxels.
    pub fn clear(&mut self) {
        self.seen.clear();
        self.oldest = 0;
    }

    /// Begins the next sub-field.
    pub fn turn(&mut self) {
        self.field = self.field.wrapping_add(1);
    }

    /// Stores a taxel; returns one that agrees with it. `within`: index of the present sub-field in its
    /// frame, of `count`.
    pub fn agree(&mut self, taxel: u16, spot: Spot, within: usize, count: usize) -> Option<u16> {
        let near = |seen: &&SeenTaxel| {
            let age = self.field.wrapping_sub(seen.field) as usize;
            let reach = if age <= within { NEAR } else { NEXT };
            age < count && seen.taxel != taxel && seen.spot.is_near(spot, reach)
        };
        let other = self.seen.iter().find(near).map(|seen| seen.taxel);
        let new = SeenTaxel { taxel, spot, field: self.field };
        if self.seen.push(new).is_err() {
            if let Some(seen) = self.seen.get_mut(usize::from(self.oldest)) {
                *seen = new;
            }
            self.oldest = (self.oldest + 1) % SEEN as u8;
        }
        other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(row: u16, column: u16) -> Spot {
        Spot { panel: 0, row, column }
    }

    #[test]
    fn two_agree_within_a_frame_or_as_neighbours() {
        let mut recent = Recent::new();
        assert_eq!(recent.agree(1, spot(4, 4), 6, 8), None);
        assert_eq!(recent.agree(1, spot(4, 4), 6, 8), None, "the same taxel");
        assert_eq!(recent.agree(2, spot(4, 7), 6, 8), None, "three columns apart");
        assert_eq!(recent.agree(3, Spot { panel: 1, ..spot(4, 4) }, 6, 8), None, "another panel");
        assert_eq!(recent.agree(4, spot(6, 3), 6, 8), Some(1));
        // The next frame: two apart no longer agree, neighbours do for the time of a frame.
        (0..2).for_each(|_| recent.turn());
        assert_eq!(recent.agree(5, spot(2, 4), 0, 8), None);
        assert_eq!(recent.agree(6, spot(4, 3), 0, 8), Some(1));
        (0..8).for_each(|_| recent.turn());
        assert_eq!(recent.agree(7, spot(4, 5), 0, 8), None, "a frame ago");
    }

    #[test]
    fn the_oldest_make_room() {
        let mut recent = Recent::new();
        (0..SEEN as u16 + 1).for_each(|k| assert_eq!(recent.agree(k, spot(5 * k, 0), 7, 8), None));
        assert_eq!(recent.agree(100, spot(0, 1), 7, 8), None, "forgotten");
        assert_eq!(recent.agree(101, spot(5 * SEEN as u16, 1), 7, 8), Some(SEEN as u16));
    }
}
