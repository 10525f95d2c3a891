//! Patches that drift, told from touches by how long they go unfelt.
//!
//! A touch over a width of taxels is felt within some seconds, or rises so slowly that nothing tells it from drift. So what rises faster than
//! is followed, over most of a group of eight taxels, and is not felt for [6 s](PATCH_TURNS), is a patch: it is followed faster from then on. If
//! it is felt sooner it is a touch, and what was followed of it meanwhile is given back.

use super::rates::{OWN, PATCH_STAYS, PATCH_TURNS, TURN_US, in_time};

/// Taxels of a group: eight that follow each other in a row.
pub(super) const GROUP: usize = 8;
/// So many of them that rise are no noise.
const SOME: u32 = 2;

/// What is known of a group.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Patch(u8);

impl Patch {
    /// Nothing.
    pub const NONE: Patch = Patch(0);

    /// Whether it drifts by itself.
    pub const fn drifts(self) -> bool {
        self.0 > PATCH_TURNS
    }

    /// The group beside it drifts: so does this one, if some of it has risen for as long.
    pub fn spread(&mut self) {
        if self.0 == PATCH_TURNS {
            self.0 += PATCH_STAYS;
        }
    }

    /// Takes in a visit in which so many of its taxels rise.
    pub fn visit(&mut self, rising: u32, taxels: u32) {
        self.0 = match rising {
            // Half of them: a finger is not so wide.
            SOME.. if self.0 >= PATCH_TURNS && rising * 2 >= taxels => PATCH_TURNS + PATCH_STAYS,
            SOME.. if self.0 < PATCH_TURNS => self.0 + 1,
            SOME.. => self.0,
            _ => self.0.saturating_sub(1),
        };
    }

    /// It is a touch: how much of that was followed, counts.
    pub fn give_back(&mut self) -> i32 {
        if self.drifts() {
            return 0;
        }
        let turns = core::mem::take(&mut self.0);
        (in_time(OWN, u32::from(turns) * (TURN_US / 1000)) >> 8) as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_felt_for_six_seconds_is_a_patch() {
        let mut patch = Patch::NONE;
        for _ in 0..PATCH_TURNS {
            patch.visit(6, 8);
            assert!(!patch.drifts());
        }
        patch.visit(6, 8);
        assert!(patch.drifts() && patch.give_back() == 0);
        for _ in 0..PATCH_STAYS {
            assert!(patch.drifts());
            patch.visit(0, 8);
        }
        assert!(!patch.drifts());
    }

    #[test]
    fn a_touch_gets_back_what_was_followed() {
        let mut patch = Patch::NONE;
        (0..10).for_each(|_| patch.visit(3, 8));
        patch.visit(1, 8);
        assert_eq!(patch.give_back(), 6); // 9 turns: 3.1 s
        assert_eq!((patch, patch.clone().give_back()), (Patch::NONE, 0));
        (0..100).for_each(|_| patch.visit(3, 8));
        assert!(!patch.drifts(), "a finger is no patch");
    }
}
