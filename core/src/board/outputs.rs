//! The output pins of reactions: levels that are still to be driven.

use crate::react::Reactions;

/// Levels to be driven: the newest for each pin, so that none is lost however many change before the next
/// tick.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Outputs {
    /// Bit `i`: GPIO `i` has to be driven.
    due: u64,
    /// Bit `i`: level of GPIO `i`.
    high: u64,
}

impl Outputs {
    /// The outputs of all reactions at their levels of rest.
    pub fn at_rest(reactions: &Reactions) -> Outputs {
        let mut outputs = Outputs::default();
        for line in reactions.outputs() {
            outputs.set(line.pin, line.inverted);
        }
        outputs
    }

    /// Sets the level of a pin below 64, which the setup has checked.
    pub fn set(&mut self, pin: u8, level: bool) {
        let bit = 1u64.checked_shl(pin.into()).unwrap_or(0);
        self.due |= bit;
        self.high = if level { self.high | bit } else { self.high & !bit };
    }

    /// Sets the level of a pin, if there is one.
    pub fn apply(&mut self, pin: Option<(u8, bool)>) {
        pin.into_iter().for_each(|(pin, level)| self.set(pin, level));
    }

    /// Merges `later` into this; its levels prevail.
    pub fn follow(&mut self, later: Outputs) {
        self.due |= later.due;
        self.high = (self.high & !later.due) | (later.high & later.due);
    }

    /// Returns the next pin to drive, and its level.
    pub fn next(&mut self) -> Option<(u8, bool)> {
        let rest = self.due.checked_sub(1)?;
        let bit = self.due & !rest;
        self.due &= rest;
        Some((bit.trailing_zeros() as u8, self.high & bit != 0))
    }
}

#[cfg(test)]
mod tests {
    use super::Outputs;

    #[test]
    fn each_pin_is_driven_once_to_its_newest_level() {
        let mut outputs = Outputs::default();
        for pin in 0..64 {
            outputs.set(pin, pin % 2 == 0);
        }
        let mut later = Outputs::default();
        for (pin, level) in [(3, true), (63, true), (63, false)] {
            later.set(pin, level);
        }
        outputs.follow(later);
        outputs.set(4, false);
        for pin in 0..64 {
            assert_eq!(outputs.next(), Some((pin, pin == 3 || (pin % 2 == 0 && pin != 4))));
        }
        assert_eq!(outputs.next(), None);
    }
}
