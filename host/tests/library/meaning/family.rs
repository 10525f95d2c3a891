//! What people do to a robot, and what a person who looks on would say to it.

use taxel_core::garment::Garment;
use taxel_core::intent::Leading;

/// What a person would say to a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// It is kind: kindness is told, and nothing worse.
    Kind,
    /// It is well meant, or means nothing: kindness or nothing is told.
    Friendly,
    /// It means nothing: nothing is told.
    Nothing,
    /// It may startle: something is told once at most, and from then on nothing.
    Once,
    /// It is a threat or an attack.
    Harmful,
    /// It is an attack.
    Attack,
}

/// A kind of touch.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// What people call it.
    pub name: &'static str,
    /// What they would say.
    pub wish: Wish,
}

/// Gives the codes of the scan that starts at a time (us).
pub type Scans = Box<dyn FnMut(u64, &mut [u16])>;

/// One touch: when its force begins and ends, on what garment, seen how often.
pub struct Act {
    /// What it is.
    pub family: Family,
    /// Begin and end of its force, us.
    pub span: (u64, u64),
    /// Time from frame to frame, us.
    pub period_us: u64,
    /// What wears the touch.
    pub garment: Garment,
    /// In numbers, for whoever looks for why it was misunderstood.
    pub note: String,
    /// The codes of the scan that starts at a time (us).
    pub codes: Scans,
}

/// What was announced, and how long after the begin of its force (ms).
pub type Told = Vec<(Leading, i64)>;

impl Wish {
    /// Whether a person would agree with what was announced, to a touch that lasts so long.
    pub fn agrees(self, told: &Told, lasts_ms: i64) -> bool {
        let any = |of: Leading| told.iter().any(|(leading, _)| *leading == of);
        let harm = any(Leading::Threat) || any(Leading::Attack);
        match self {
            Wish::Kind | Wish::Friendly => !harm,
            Wish::Nothing => !harm && !any(Leading::Kindness),
            Wish::Once => {
                let said = told.iter().filter(|(leading, _)| *leading != Leading::None).count();
                let over = |last: &(Leading, i64)| last.0 == Leading::None && last.1 < lasts_ms;
                said <= 1 && told.last().is_none_or(over)
            }
            Wish::Harmful => harm,
            Wish::Attack => any(Leading::Attack),
        }
    }
}
