//! Kinds of touches, and the intentions behind them.

use taxel_core::intent::Leading;

/// A kind of touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The flat hand comes down lightly, a few times.
    Pat,
    /// The hand, or fingers, move lightly along.
    Stroke,
    /// A fingertip or two, lightly, a few times.
    Tap,
    /// The hand presses firmly and stays.
    Hold,
    /// The hand closes firmly, and lets go soon.
    Grab,
    /// The flat hand hits.
    Slap,
    /// The fist hits.
    Punch,
    /// A strap hits.
    Lash,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 8] =
        [Kind::Pat, Kind::Stroke, Kind::Tap, Kind::Hold, Kind::Grab, Kind::Slap, Kind::Punch, Kind::Lash];

    /// The intention.
    pub fn meaning(self) -> Leading {
        match self {
            Kind::Pat | Kind::Stroke | Kind::Tap => Leading::Kindness,
            Kind::Hold | Kind::Grab => Leading::Threat,
            Kind::Slap | Kind::Punch | Kind::Lash => Leading::Attack,
        }
    }
}

/// One act of a person.
#[derive(Debug, Clone)]
pub struct Act {
    /// Kind.
    pub kind: Kind,
    /// Begin and end of its force, us.
    pub span: (u64, u64),
    /// Parameters, to analyse a failure.
    pub note: String,
}

/// Acts of one person on a garment, one after the other.
pub trait Session {
    /// The garment.
    fn garment(&self) -> taxel_core::garment::Garment;
    /// Acts in order of time, with pauses of at least 0.9 s.
    fn acts(&self) -> &[Act];
    /// Fills in the codes of the scan that starts at this time, us.
    fn frame(&mut self, start_us: u64, codes: &mut [u16]);
}
