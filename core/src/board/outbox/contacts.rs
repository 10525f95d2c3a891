//! The list of contacts that waits for the link. Present contacts are reported from the table of contacts; only
//! those that have left it are copied.

use crate::body::Placed;
use crate::contact::{Contact, Phase};
use crate::format::Micros;
use crate::pipeline::CONTACTS;
use crate::unsure::UnsureState;
use crate::wire::{Each, Health, LISTED};
use heapless::Vec;
use serde::ser::{Serialize, SerializeSeq, SerializeStruct, Serializer};

/// Reports due on the newest frame, and on what ended since the last list was sent.
pub(super) struct ContactQueue {
    /// True if the list is to be sent.
    pub waits: bool,
    /// Number of the newest frame.
    pub frame: u32,
    /// Time of the frame.
    pub time: Micros,
    /// Number of contacts that had no room in that frame.
    pub dropped: u16,
    /// Number of present contacts that have a place in the list: the first ones.
    listed: u16,
    /// Present contacts whose onset was not reported yet.
    begun: Vec<Begun, CONTACTS>,
    /// Contacts that ended, in the order of the list.
    ended: Vec<Ended, CONTACTS>,
}

/// A contact whose onset was not reported yet, in the last frame in which it was present.
#[derive(Clone, Copy)]
struct Begun {
    id: u32,
    total: u32,
    duration_ms: u32,
}

/// A contact that ended.
struct Ended {
    placed: Placed,
    /// Number of the frame with which it ended.
    frame: u32,
    /// Set if its onset was not reported yet either.
    begun: Option<Begun>,
}

impl Begun {
    fn of(placed: &Placed) -> Begun {
        let contact = &placed.contact;
        Begun { id: contact.id, total: contact.total, duration_ms: contact.duration_ms }
    }
}

impl Ended {
    /// Number of its entries in the list.
    fn entries(&self) -> usize {
        if self.begun.is_some() { 2 } else { 1 }
    }
}

impl ContactQueue {
    pub const fn new() -> Self {
        ContactQueue {
            waits: false,
            frame: 0,
            time: Micros(0),
            dropped: 0,
            listed: 0,
            begun: Vec::new(),
            ended: Vec::new(),
        }
    }

    /// Drops everything.
    pub fn clear(&mut self) {
        self.waits = false;
        self.begun.clear();
        self.ended.clear();
    }

    /// Resets the classes of the contacts that ended: those of another base of shapes.
    pub fn forget_classes(&mut self) {
        self.ended.iter_mut().for_each(|ended| ended.placed.shape.forget_class());
    }

    /// Takes the contacts of the newest frame that are present, and those that ended; `due` if the rate of
    /// the stream allows a list of it. Onsets and ends are always sent.
    pub fn take(
        &mut self,
        (frame, time): (u32, Micros),
        [present, released]: [&[Placed]; 2],
        due: bool,
        health: &mut Health,
    ) {
        if self.waits {
            health.thinned_contacts += u32::from(due);
        } else {
            self.clear();
        }
        (self.frame, self.time, self.dropped) = (frame, time, 0);
        if self.ended.is_empty() && released.is_empty() {
            self.listed = present.len() as u16;
        } else {
            self.end(present, released, health);
        }
        self.begun.retain_mut(|begun| {
            let placed = present.iter().find(|placed| placed.contact.id == begun.id);
            placed.is_some_and(|placed| {
                *begun = Begun::of(placed);
                true
            })
        });
        let mut news = false;
        let is_onset = |placed: &Placed| placed.contact.phase == Phase::Onset;
        for (index, placed) in present.iter().enumerate().filter(|(_, placed)| is_onset(placed)) {
            news = true;
            if index < self.listed.into() && self.begun_of(placed).is_none() {
                // Always room: as many places as contacts.
                let _ = self.begun.push(Begun::of(placed));
            }
        }
        self.waits |= due || news || !released.is_empty();
    }

    /// Keeps the contacts that ended with the frame, and counts those that have no place in the list: the
    /// present ones come first.
    #[inline(never)] // M0+: out of line
    fn end(&mut self, present: &[Placed], released: &[Placed], health: &mut Health) {
        let onsets = released.iter().filter(|placed| self.begun_of(placed).is_some()).count();
        let entries = self.ended.iter().map(Ended::entries).sum::<usize>();
        let room = LISTED.saturating_sub(entries + onsets);
        let listed = present.len().min(room);
        health.lost += (present.len() - listed) as u32;
        self.listed = listed as u16;
        for (index, placed) in released.iter().enumerate() {
            let begun = self.begun_of(placed);
            let ended = Ended { placed: placed.clone(), frame: self.frame, begun };
            let fits = index < room - listed && self.ended.push(ended).is_ok();
            health.lost += u32::from(!fits);
        }
    }

    fn begun_of(&self, placed: &Placed) -> Option<Begun> {
        self.begun.iter().find(|begun| begun.id == placed.contact.id).copied()
    }

    /// The present contacts that have a place in the list.
    fn listed<'a>(&self, present: &'a [Placed]) -> impl Iterator<Item = &'a Placed> + Clone + use<'a> {
        present.iter().take(self.listed.into())
    }

    /// Fills in the entries of the list. The present contacts stand before the ends of the newest frame. An
    /// onset stands where its contact was while it was present: before the ends of the frame before its own.
    #[inline(never)] // M0+: out of line
    fn list<'a>(&'a self, present: &'a [Placed], entries: &mut Vec<Listed<'a>, LISTED>) {
        let (mut group, mut rest) = first_group(&self.ended);
        onsets(group, entries);
        while !group.is_empty() {
            let frame = group.first().map_or(0, |ended| ended.frame);
            let (next, after) = first_group(rest);
            let follows = next.first().is_some_and(|next| next.frame == frame.wrapping_add(1));
            if follows {
                onsets(next, entries);
            }
            if frame == self.frame {
                self.list_present(present, entries);
            }
            for ended in group {
                let _ = entries.push((&ended.placed, None));
            }
            if !follows {
                onsets(next, entries);
            }
            (group, rest) = (next, after);
        }
        if self.ended.last().is_none_or(|last| last.frame != self.frame) {
            self.list_present(present, entries);
        }
    }

    fn list_present<'a>(&'a self, present: &'a [Placed], entries: &mut Vec<Listed<'a>, LISTED>) {
        for placed in self.listed(present) {
            let _ = entries.push((placed, self.begun_of(placed)));
        }
    }
}

/// The contacts that ended with the same frame as the first, and the rest.
fn first_group(ended: &[Ended]) -> (&[Ended], &[Ended]) {
    let frame = ended.first().map_or(0, |first| first.frame);
    let count = ended.iter().take_while(|ended| ended.frame == frame).count();
    (ended.get(..count).unwrap_or(&[]), ended.get(count..).unwrap_or(&[]))
}

/// Adds the onsets that were not reported. There is room: `ContactQueue::end` has counted, here and elsewhere.
fn onsets<'a>(group: &'a [Ended], entries: &mut Vec<Listed<'a>, LISTED>) {
    for ended in group.iter().filter(|ended| ended.begun.is_some()) {
        let _ = entries.push((&ended.placed, ended.begun));
    }
}

/// A contact; if its onset is reported, with total and duration of then. With the end only these change.
type Listed<'a> = (&'a Placed, Option<Begun>);

/// A [`ContactList`](crate::wire::ContactList) of what waits and of the table's present contacts.
pub(super) struct List<'a> {
    queue: &'a ContactQueue,
    present: &'a [Placed],
    unsure: &'a UnsureState<CONTACTS>,
    /// Ages of the forms of the present contacts; empty if they are not reported.
    ages: &'a [u8],
}

impl<'a> List<'a> {
    pub fn of(
        queue: &'a ContactQueue,
        present: &'a [Placed],
        unsure: &'a UnsureState<CONTACTS>,
        ages: &'a [u8],
    ) -> List<'a> {
        List { queue, present, unsure, ages }
    }
}

impl Serialize for List<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let List { queue, present, unsure, ages } = self;
        let mut entries = Vec::new();
        queue.list(present, &mut entries);
        let mut list = serializer.serialize_struct("ContactList", 6)?;
        list.serialize_field("frame", &queue.frame)?;
        list.serialize_field("time", &queue.time)?;
        list.serialize_field("dropped", &queue.dropped)?;
        list.serialize_field("contacts", &Entries(&entries))?;
        let id = |placed: &Placed| placed.contact.id;
        let doubted = queue.listed(present).enumerate().filter(|(index, _)| unsure.is_unsure(*index));
        let aged = queue.listed(present).zip(ages.iter()).filter(|(_, age)| **age > 0);
        // Most lists have neither, and a reader takes what is missing as empty.
        if doubted.clone().next().is_some() || aged.clone().next().is_some() {
            list.serialize_field("unsure", &Each(doubted.map(|(_, placed)| id(placed))))?;
            list.serialize_field("form_ages", &Each(aged.map(|(placed, age)| (id(placed), *age))))?;
        }
        list.end()
    }
}

struct Entries<'a>(&'a [Listed<'a>]);

impl Serialize for Entries<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut entries = serializer.serialize_seq(Some(self.0.len()))?;
        for (placed, begun) in self.0 {
            let mut onset = None;
            if let Some(Begun { total, duration_ms, .. }) = *begun {
                let contact = Contact { phase: Phase::Onset, total, duration_ms, ..placed.contact.clone() };
                onset = Some(Placed { contact, ..**placed });
            }
            entries.serialize_element(onset.as_ref().unwrap_or(placed))?;
        }
        entries.end()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::wire::ContactList;

    fn placed(id: u32, phase: Phase, total: u32) -> Placed {
        let contact = Contact { phase, peak: 9, duration_ms: total / 7, ..Contact::of_nine(id, 0, total) };
        contact.into()
    }

    /// The list as a copy of every contact, in which onsets and ends stay until they are sent.
    fn copied(list: &mut std::vec::Vec<Placed>, present: &[Placed], released: &[Placed]) {
        let unreported: std::vec::Vec<u32> =
            list.iter().filter(|p| p.contact.phase == Phase::Onset).map(|p| p.contact.id).collect();
        let is_present = |id| present.iter().any(|p| p.contact.id == id);
        list.retain(|old| match old.contact.phase {
            Phase::Onset => !is_present(old.contact.id),
            Phase::Held => false,
            Phase::Released => true,
        });
        for placed in present {
            let mut placed = placed.clone();
            if unreported.contains(&placed.contact.id) {
                placed.contact.phase = Phase::Onset;
            }
            list.push(placed);
        }
        list.extend(released.iter().cloned());
    }

    #[test]
    fn the_list_is_that_of_a_copy_however_long_it_waits() {
        let mut rng = fastrand::Rng::with_seed(7);
        let mut queue = ContactQueue::new();
        let (mut list, mut present, mut id) = (std::vec::Vec::new(), std::vec::Vec::<Placed>::new(), 0);
        let mut waited = 0;
        for frame in 1..4000u32 {
            let mut released = std::vec::Vec::new();
            present.retain_mut(|placed| {
                let contact = &mut placed.contact;
                let ends = rng.u8(..8) == 0 && waited < 8;
                (contact.phase, contact.duration_ms) = (Phase::Held, contact.duration_ms + 5);
                contact.total = if ends { 0 } else { rng.u32(100..9000) };
                if ends {
                    contact.phase = Phase::Released;
                    released.push(placed.clone());
                }
                !ends
            });
            if rng.bool() && present.len() < 5 {
                id += 1;
                present.push(placed(id, Phase::Onset, rng.u32(100..9000)));
            }
            if !queue.waits {
                list.clear();
            }
            copied(&mut list, &present, &released);
            let mut health = Health::default();
            queue.take((frame, Micros(frame.into())), [&present, &released], rng.bool(), &mut health);
            assert_eq!(health.lost, 0);
            let copy = ContactList {
                frame,
                time: Micros(frame.into()),
                dropped: 0,
                contacts: list.iter().cloned().collect(),
                unsure: Vec::new(),
                form_ages: Vec::new(),
            };
            let unsure = UnsureState::default();
            let encoded = postcard::to_allocvec(&List::of(&queue, &present, &unsure, &[])).unwrap();
            assert_eq!([&encoded[..], &[0, 0]].concat(), postcard::to_allocvec(&copy).unwrap());
            waited = if queue.waits { waited + 1 } else { 0 };
            if rng.u8(..6) == 0 {
                (queue.waits, waited) = (false, 0);
            }
        }
        assert!(id > 500);
    }
}
