//! Acts of a hand on the garment.

use super::touch::Touch;
use super::trace::{Knot, Trace};

/// One of its acts. Touches and traces are numbered, each kind for itself.
#[derive(Debug)]
pub(super) enum Act {
    /// A touch begins.
    Touch(u64, Touch),
    /// A touch along a path begins; its last knot lasts if the touch does.
    Trace { number: u64, trace: Trace, lasts: bool },
    /// The path of a touch that lasts goes on.
    Draw { number: u64, path: Vec<Knot>, lasts: bool },
}
