//! Confidence that a decision needs to be announced.

use crate::format::{Invalid, Q15};

/// Confidence that an announcement needs; 0 by default. A touch that never reaches it is reported at its end.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Certainty(Q15);

impl Certainty {
    /// From thousandths, at most 999. Error if there are more.
    pub const fn of(thousandths: u16) -> Result<Certainty, Invalid> {
        if thousandths > 999 {
            return Err(Invalid { parameter: "gestures.certainty", must: "must be at most 999 (0.999)" });
        }
        Ok(Certainty(Q15::ratio(thousandths as u64, 1000)))
    }

    /// True if a decision has enough confidence; an unknown confidence counts as 0.
    pub fn allows(self, confidence: Option<Q15>) -> bool {
        confidence.unwrap_or_default() >= self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousandths_are_shares_and_1000_are_refused_by_name() {
        let half = Certainty::of(500).unwrap();
        assert!(half.allows(Some(Q15(16_384))) && !half.allows(Some(Q15(16_383))) && !half.allows(None));
        assert_eq!(Certainty::of(0), Ok(Certainty::default()));
        assert!(Certainty::default().allows(None));
        assert!(Certainty::of(999).unwrap().allows(Some(Q15::ONE)));
        assert_eq!(Certainty::of(1000).unwrap_err().parameter, "gestures.certainty");
    }
}
