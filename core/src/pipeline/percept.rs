//! What comes out.

use super::state::CONTACTS;
use crate::body::Placed;
use crate::condition::Tare;
use crate::format::Name;
use crate::gesture::Gesture;
use crate::intent::Meaning;
use crate::react::ReactState;
use crate::symbol::SymbolState;
use crate::unsure::UnsureState;

/// What was perceived in one frame.
#[derive(Debug, Clone)]
pub struct Percept<'a> {
    /// Conditioned image by taxel number, background zero.
    pub image: &'a [u16],
    /// Contacts that are there.
    pub present: &'a [Placed],
    /// How many frames old the form of each of those is; 255: at least so many.
    pub form_ages: &'a [u8],
    /// Contacts that have gone.
    pub released: &'a [Placed],
    /// Contacts that did not fit, and runs that did not.
    pub dropped: u16,
    /// Which of those that are there may be drift.
    pub unsure: &'a UnsureState<CONTACTS>,
    /// What was said of them.
    pub symbols: &'a SymbolState<CONTACTS>,
    /// What the touch means, if that is new.
    pub meaning: Option<&'a Meaning>,
    /// What goes on and what that is called, if it is new.
    pub gesture: Option<(Gesture, Name)>,
    /// What the garment does by itself.
    pub reactions: &'a ReactState,
    /// How far a tare is.
    pub tare: Tare,
}
