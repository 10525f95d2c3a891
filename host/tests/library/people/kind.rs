//! What people do to a garment, and what they mean by it.

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

    /// What is meant by it.
    pub fn meaning(self) -> Leading {
        match self {
            Kind::Pat | Kind::Stroke | Kind::Tap => Leading::Kindness,
            Kind::Hold | Kind::Grab => Leading::Threat,
            Kind::Slap | Kind::Punch | Kind::Lash => Leading::Attack,
        }
    }
}

/// Something that somebody did.
#[derive(Debug, Clone)]
pub struct Act {
    /// What.
    pub kind: Kind,
    /// Begin and end of its force, us.
    pub span: (u64, u64),
    /// In numbers, for whoever looks for why it was misunderstood.
    pub note: String,
}

/// What one person does to a garment, one thing after the other.
pub trait Session {
    /// What the garment is.
    fn garment(&self) -> taxel_core::garment::Garment;
    /// What is done, in order of time, with pauses of at least 0.9 s.
    fn acts(&self) -> &[Act];
    /// The codes of the scan that starts at that time, us.
    fn frame(&mut self, start_us: u64, codes: &mut [u16]);
}
