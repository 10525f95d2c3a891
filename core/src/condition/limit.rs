//! The limit of each taxel, kept beside its calibration: an inactive taxel is only compared with it.

use super::calibrate::scale;
use super::state::{ConditionState, UNITY};
use super::terms::Terms;
use crate::format::Code;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Recomputes the limits if they are for other terms, or for another calibration.
    pub(super) fn set_limits(&mut self, terms: Terms) {
        if self.limits_for == Some(terms) {
            return;
        }
        self.limits_for = Some(terms);
        self.plain = self.gain.iter().all(is_plain);
        // Neighbours often have the same gain.
        let (mut last, mut margin) = (0, u16::MAX);
        for ((limit, rest), gain) in self.limit.iter_mut().zip(&self.baseline).zip(&self.gain) {
            if *gain != last {
                (last, margin) = (*gain, terms.margin(*gain));
            }
            *limit = terms.limit(*rest, margin);
        }
    }

    /// Recomputes the limit of one taxel, whose calibration has changed.
    pub(super) fn set_limit(&mut self, taxel: usize) {
        let calibration = self.baseline.get(taxel).zip(self.gain.get(taxel));
        if let (Some(terms), Some((rest, gain)), Some(limit)) =
            (self.limits_for, calibration, self.limit.get_mut(taxel))
        {
            *limit = terms.limit(*rest, terms.margin(*gain));
            self.plain &= is_plain(gain);
        }
    }

    /// Last code of a taxel with less than `level` counts of pressure; the end of the range for a silenced
    /// taxel.
    pub fn quiet_code(&self, taxel: usize, level: u16, falling: bool) -> u16 {
        let terms = Terms { floor: level, falling };
        let calibration = self.baseline.get(taxel).zip(self.gain.get(taxel));
        calibration.map_or(terms.silent(), |(rest, gain)| {
            let margin = if *gain == UNITY { terms.margin_of_unity() } else { terms.margin(*gain) };
            terms.limit(*rest, margin)
        })
    }

    /// Pressure of a taxel at a code, counts.
    pub fn pressure(&self, taxel: usize, code: Code, falling: bool) -> u16 {
        let mut value = [0];
        if let Some((rest, gain)) = self.baseline.get(taxel).zip(self.gain.get(taxel)) {
            let scale = if falling { scale::<1, true> } else { scale::<1, false> };
            scale(&[code], &[*rest], &[*rest], &[*gain], &mut value);
        }
        let [value] = value;
        value
    }
}

fn is_plain(gain: &u16) -> bool {
    matches!(*gain, 0 | UNITY)
}
