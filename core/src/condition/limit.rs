//! How far the code of a taxel may go before it counts: its own limit, so that a quiet taxel is compared and left.

use super::state::ConditionState;

/// What the limits are for: the floor, and whether pressure lowers the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Terms {
    pub floor: u16,
    pub falling: bool,
}

impl Terms {
    /// The greatest difference that comes to less than the floor: `(d gain + 2048) >> 12 < floor`.
    pub fn margin(&self, gain: u16) -> u16 {
        let below = (u32::from(self.floor) << 12).saturating_sub(2049);
        below.checked_div(gain.into()).map_or(u16::MAX, |margin| margin.min(0xffff) as u16)
    }

    /// The last code that is quiet. No code is beyond 65535, or 0: where the margin reaches so far, none is loud.
    pub fn limit(&self, rest: u16, margin: u16) -> u16 {
        if self.falling { rest.saturating_sub(margin) } else { rest.saturating_add(margin) }
    }

    /// The limit that no code passes.
    pub fn silent(&self) -> u16 {
        if self.falling { 0 } else { u16::MAX }
    }
}

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Sets the limits anew if they are for other terms, or for another calibration.
    pub(super) fn set_limits(&mut self, terms: Terms) {
        if self.limits_for == Some(terms) {
            return;
        }
        self.limits_for = Some(terms);
        // Neighbours often have the same gain.
        let (mut last, mut margin) = (0, u16::MAX);
        for ((limit, rest), gain) in self.limit.iter_mut().zip(&self.baseline).zip(&self.gain) {
            if *gain != last {
                (last, margin) = (*gain, terms.margin(*gain));
            }
            *limit = terms.limit(*rest, margin);
        }
    }

    /// The same for one taxel, whose calibration has changed.
    pub(super) fn set_limit(&mut self, taxel: usize) {
        let calibration = self.baseline.get(taxel).zip(self.gain.get(taxel));
        if let (Some(terms), Some((rest, gain)), Some(limit)) =
            (self.limits_for, calibration, self.limit.get_mut(taxel))
        {
            *limit = terms.limit(*rest, terms.margin(*gain));
        }
    }
}
