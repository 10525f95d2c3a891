//! What is told of a taxel at a seam in a scan.

use taxel_core::condition::{MARGIN, WithheldTaxel, stands_out};

/// A taxel at a seam in a scan, counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamValue {
    /// What its board's filter left of it.
    pub told: u16,
    /// Its pressure before the filter: more than is told if that was withheld.
    pub value: u16,
    /// Greatest pressure of its neighbours on its panel; all that there may be where nothing is clamped.
    pub beside: u16,
}

impl From<&WithheldTaxel> for SeamValue {
    /// Without an image, it has what is left of it from its neighbours.
    fn from(withheld: &WithheldTaxel) -> SeamValue {
        let WithheldTaxel { value, filtered, .. } = *withheld;
        SeamValue { told: filtered, value, beside: filtered }
    }
}

impl SeamValue {
    /// Clamped to the greatest of its neighbours, those beyond the seam included.
    fn smooth(self, beyond: u16) -> u16 {
        self.value.min(self.beside.max(beyond))
    }

    /// Its value, if it stands out from all of its neighbours.
    pub fn stood_out(self, beyond: u16) -> Option<u16> {
        stands_out(self.value, self.smooth(beyond)).then_some(self.value)
    }

    /// The least and the most that may press on it: of what was clamped to its neighbours, a little may be
    /// withheld that is not told.
    pub fn range(self) -> [u16; 2] {
        let is_clamped = self.value == self.told && self.told == self.beside;
        let more = if is_clamped { (self.told / 16).saturating_add(MARGIN) } else { 0 };
        [self.value, self.value.saturating_add(more)]
    }

    /// What a filter over both panels leaves of it: [`Filter::Persistent`](taxel_core::condition::Filter). If it
    /// stood out in the previous scan, too, it had `lasting`.
    pub fn filtered_by_all(self, beyond: u16, lasting: Option<u16>) -> u16 {
        let smooth = self.smooth(beyond);
        let lasting = lasting.filter(|_| stands_out(self.value, smooth));
        lasting.map_or(smooth, |lasting| smooth.max(lasting.min(self.value)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINT: SeamValue = SeamValue { told: 300, value: 900, beside: 300 };

    #[test]
    fn a_point_is_clamped_to_what_presses_on_either_side_until_it_lasts() {
        for (beyond, once, lasting) in [(0, 300, 800), (500, 500, 800), (850, 850, 850), (2_000, 900, 900)] {
            assert_eq!(POINT.filtered_by_all(beyond, None), once, "{beyond}");
            assert_eq!(POINT.filtered_by_all(beyond, Some(800)), lasting, "{beyond}");
            assert_eq!(POINT.stood_out(beyond), (beyond < 700).then_some(900), "{beyond}");
        }
    }

    #[test]
    fn what_is_not_clamped_presses_as_it_is_told() {
        let clamped = SeamValue { told: 320, value: 320, beside: 320 };
        assert_eq!(clamped.range(), [320, 320 + 20 + 64]);
        assert_eq!(SeamValue { beside: 321, ..clamped }.range(), [320; 2]);
        assert_eq!(POINT.range(), [900; 2]);
    }
}
