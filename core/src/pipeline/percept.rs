//! The result of a frame.

use super::state::CONTACTS;
use crate::body::Placed;
use crate::condition::Tare;
use crate::format::Name;
use crate::gesture::Gesture;
use crate::intent::Meaning;
use crate::react::ReactState;
use crate::symbol::{Symbol, SymbolState};
use crate::unsure::UnsureState;

/// Everything perceived in one frame.
#[derive(Debug, Clone)]
pub struct Percept<'a> {
    /// Conditioned image by taxel number, background zero.
    pub image: &'a [u16],
    /// Present contacts.
    pub present: &'a [Placed],
    /// Age of the form of each present contact, frames; saturates at 255.
    pub form_ages: &'a [u8],
    /// Contacts released in this frame.
    pub released: &'a [Placed],
    /// Number of contacts and runs for which there was no room.
    pub dropped: u16,
    /// Which present contacts may be drift.
    pub unsure: &'a UnsureState<CONTACTS>,
    /// Words for the contacts.
    pub symbols: &'a SymbolState<CONTACTS>,
    /// Meaning of the touch, if it is new.
    pub meaning: Option<&'a Meaning>,
    /// Gesture and its name, if it is new.
    pub gesture: Option<(Gesture, Name)>,
    /// Reactions that the board runs by itself.
    pub reactions: &'a ReactState,
    /// Progress of a tare.
    pub tare: Tare,
}

impl Percept<'_> {
    /// Events of the frame: onsets and changes of words of the present contacts, then releases.
    pub fn events(&self) -> impl Iterator<Item = Symbol> {
        self.symbols.events(self.present, self.released)
    }
}
