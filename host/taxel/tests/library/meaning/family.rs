//! Families of touches, and a person's judgement of them.

use taxel_core::garment::Garment;
use taxel_core::intent::Leading;

/// Judgement of a touch by a person.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expected {
    /// Kind: kindness is announced, and nothing worse.
    Kind,
    /// Friendly or meaningless: kindness or nothing is announced.
    Friendly,
    /// Meaningless: nothing is announced.
    Nothing,
    /// Possibly startling: at most one announcement, and nothing afterwards.
    Once,
    /// A threat or an attack.
    Harmful,
    /// An attack.
    Attack,
}

/// A family of touches.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// Name.
    pub name: &'static str,
    /// Judgement of a person.
    pub expected: Expected,
}

/// Fills in the codes of the scan that starts at a time (us).
pub type Scans = Box<dyn FnMut(u64, &mut [u16])>;

/// One touch, its garment and its frame rate.
pub struct Act {
    /// Family of the touch.
    pub family: Family,
    /// Begin and end of its force, us.
    pub span: (u64, u64),
    /// Frame period, us.
    pub period_us: u64,
    /// The garment.
    pub garment: Garment,
    /// Parameters, to analyse a failure.
    pub note: String,
    /// The codes of the scan that starts at a time (us).
    pub codes: Scans,
}

/// Announcements, with the time since the begin of the force (ms).
pub type Announced = Vec<(Leading, i64)>;

impl Expected {
    /// True if a person would not want it.
    pub fn is_harmful(self) -> bool {
        matches!(self, Expected::Harmful | Expected::Attack)
    }

    /// True if a person would agree with the announcements for a touch of this duration.
    pub fn agrees(self, announced: &Announced, lasts_ms: i64) -> bool {
        let any = |of: Leading| announced.iter().any(|(leading, _)| *leading == of);
        let harm = any(Leading::Threat) || any(Leading::Attack);
        match self {
            Expected::Kind | Expected::Friendly => !harm,
            Expected::Nothing => !harm && !any(Leading::Kindness),
            Expected::Once => {
                let said = announced.iter().filter(|(leading, _)| *leading != Leading::None).count();
                let over = |last: &(Leading, i64)| last.0 == Leading::None && last.1 < lasts_ms;
                said <= 1 && announced.last().is_none_or(over)
            }
            Expected::Harmful => harm,
            Expected::Attack => any(Leading::Attack),
        }
    }
}
