//! Shapes that the host teaches the board at run time, in place of the built-in ones.
//!
//! A gallery arrives in parts: first its head, then its prototypes, some at a time. With the head the
//! built-in base takes over again; with the last prototype the gallery is in force, if it is valid.
//!
//! One contact is described per frame, new ones first: a description takes as long as everything else.

use super::confidence::ConfidenceTable;
use super::gallery::{Exemplar, GALLERY_CLASSES, GALLERY_PROTOTYPES, Gallery};
use super::knn::Class;
use super::seen::seen;
use super::space::Space;
use super::stage::Shape;
use crate::condition::Image;
use crate::contact::{Contact, ContactState, Slot};
use crate::format::{Invalid, Name, Q15};
use crate::garment::Layout;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// A gallery without its prototypes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct GalleryHead {
    /// See [`Gallery::names`].
    pub names: Vec<Name, GALLERY_CLASSES>,
    /// See [`Gallery::space`].
    pub space: Space,
    /// See [`Gallery::k`].
    pub k: u8,
    /// See [`Gallery::reject`].
    pub reject: u16,
    /// See [`Gallery::confidence`].
    #[serde(rename = "sureness")]
    pub confidence: ConfidenceTable,
    /// Number of prototypes that follow, 1 ..= [`GALLERY_PROTOTYPES`].
    pub prototypes: u16,
}

/// Result for a contact.
#[derive(Debug, Clone, Copy)]
struct Known {
    contact: u32,
    class: Class,
    confidence: Q15,
}

/// A gallery on the board, and its results. Without the feature `gallery` it has no room for any.
#[derive(Debug, Clone)]
pub struct Taught<const CONTACTS: usize> {
    gallery: Gallery<GALLERY_PROTOTYPES>,
    /// Number of prototypes that are to arrive; 0 without a gallery.
    wanted: u16,
    in_force: bool,
    known: Vec<Known, CONTACTS>,
    turn: usize,
}

impl<const CONTACTS: usize> Default for Taught<CONTACTS> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const CONTACTS: usize> Taught<CONTACTS> {
    /// State without a gallery.
    pub const fn new() -> Self {
        Taught { gallery: Gallery::new(), wanted: 0, in_force: false, known: Vec::new(), turn: 0 }
    }

    /// The gallery, if it is in force.
    pub fn gallery(&self) -> Option<&Gallery<GALLERY_PROTOTYPES>> {
        (cfg!(feature = "gallery") && self.in_force).then_some(&self.gallery)
    }

    /// Drops the gallery: the built-in base is in force.
    pub fn clear(&mut self) {
        (self.wanted, self.in_force) = (0, false);
        self.known.clear();
    }

    /// Takes the head of a new gallery. Error if the number of prototypes is out of range.
    #[inline(never)]
    pub fn begin(&mut self, head: GalleryHead) -> Result<(), Invalid> {
        self.clear();
        if !(1..=GALLERY_PROTOTYPES).contains(&usize::from(head.prototypes)) {
            return Err(Invalid { parameter: "shapes.prototypes", must: "must be 1 to 200 on this board" });
        }
        self.wanted = head.prototypes;
        let Gallery { names, space, k, reject, confidence, prototypes } = &mut self.gallery;
        prototypes.clear();
        (*names, *space, *confidence) = (head.names, head.space, head.confidence);
        (*k, *reject) = (head.k, head.reject);
        Ok(())
    }

    /// Adds prototypes. With the last one the gallery is checked, and dropped if it is invalid.
    pub fn add(&mut self, prototypes: &[Exemplar]) -> Result<(), Invalid> {
        let done = self.take(prototypes);
        if done.is_err() {
            self.clear();
        }
        done
    }

    fn take(&mut self, prototypes: &[Exemplar]) -> Result<(), Invalid> {
        let must = "must be as many as the gallery's head says";
        let surplus = Invalid { parameter: "shapes.prototypes", must };
        let held = &mut self.gallery.prototypes;
        if self.in_force || held.len() + prototypes.len() > self.wanted.into() {
            return Err(surplus);
        }
        held.extend_from_slice(prototypes).map_err(|_| surplus)?;
        if held.len() == usize::from(self.wanted) {
            self.gallery.check()?;
            self.in_force = true;
        }
        Ok(())
    }

    /// Chooses the contact to describe, given their ids: the first without a result, else each in turn.
    pub fn choose(&mut self, contacts: impl ExactSizeIterator<Item = u32> + Clone) -> Option<usize> {
        self.known.retain(|known| contacts.clone().any(|id| id == known.contact));
        let new = contacts.clone().position(|id| self.known.iter().all(|known| known.contact != id));
        self.turn = if self.turn + 1 < contacts.len() { self.turn + 1 } else { 0 };
        new.or((contacts.len() > 0).then_some(self.turn))
    }

    /// Describes and recognises a contact, number `index` of those in `contacts`; see [`seen`].
    pub fn look<const RUNS: usize, const PARTS: usize, S: Slot>(
        &mut self,
        contacts: &ContactState<CONTACTS, RUNS, PARTS, S>,
        layout: &Layout,
        image: &Image<'_>,
        (index, contact): (usize, &Contact),
    ) {
        let Some(descriptor) = seen(contacts, layout, image, (index, contact)) else { return };
        let found = self.gallery.recognise(&descriptor);
        let class = found.class.map_or(Class::UNKNOWN, |class| Class(class.saturating_add(1)));
        let known = Known { contact: contact.id, class, confidence: found.confidence };
        match self.known.iter_mut().find(|known| known.contact == contact.id) {
            Some(before) => *before = known,
            // Always room: as many places as contacts.
            None => _ = self.known.push(known),
        }
    }

    /// Replaces the built-in base's result in `shape` by that of the gallery: class, 1 + that of the gallery,
    /// and accuracy of such votes. Unknown if the contact has no result yet.
    pub fn classify(&self, contact: &Contact, shape: &mut Shape) {
        let known = self.known.iter().find(|known| known.contact == contact.id);
        (shape.class, shape.confidence) =
            known.map_or((Class::UNKNOWN, Q15(0)), |known| (known.class, known.confidence));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(prototypes: u16) -> GalleryHead {
        let weights = core::iter::once([1; 24]).collect();
        GalleryHead {
            names: ["cube", "ball"].into_iter().map(crate::format::name).collect(),
            space: Space { origin: [0; 24], weights, shift: 0 },
            k: 1,
            reject: 100,
            confidence: ConfidenceTable::default(),
            prototypes,
        }
    }

    fn exemplar(class: u8) -> Exemplar {
        Exemplar { class, at: [class.into(); 12] }
    }

    #[test]
    fn it_is_in_force_from_its_last_prototype_on() {
        let mut taught = Taught::<4>::new();
        assert_eq!(taught.begin(head(3)), Ok(()));
        assert_eq!(taught.add(&[exemplar(0), exemplar(1)]), Ok(()));
        assert!(taught.gallery().is_none());
        assert_eq!(taught.add(&[exemplar(1)]), Ok(()));
        assert_eq!(taught.gallery().map(|gallery| gallery.prototypes.len()), Some(3));
        taught.begin(head(1)).unwrap();
        assert!(taught.gallery().is_none(), "another arrives");
    }

    #[test]
    fn what_is_wrong_is_forgotten() {
        let mut taught = Taught::<4>::new();
        for count in [0, 201] {
            assert_eq!(taught.begin(head(count)).unwrap_err().parameter, "shapes.prototypes");
        }
        assert!(taught.add(&[exemplar(0)]).is_err(), "there was no head");
        taught.begin(head(1)).unwrap();
        assert_eq!(taught.add(&[exemplar(2)]).unwrap_err().parameter, "shapes.names");
        assert!(taught.add(&[exemplar(0)]).is_err() && taught.gallery().is_none());
        taught.begin(head(1)).unwrap();
        assert!(taught.add(&[exemplar(0); 2]).is_err());
        taught.begin(GalleryHead { k: 10, ..head(1) }).unwrap();
        assert_eq!(taught.add(&[exemplar(0)]).unwrap_err().parameter, "shapes.k");
    }

    #[test]
    fn new_contacts_go_first_and_all_have_their_turn() {
        let mut taught = Taught::<4>::new();
        let mut chosen = |ids: &[u32], known: &[u32]| {
            let known = known.iter().map(|contact| Known {
                contact: *contact,
                class: Class(1),
                confidence: Q15::ONE,
            });
            taught.known = known.collect();
            taught.choose(ids.iter().copied())
        };
        assert_eq!(chosen(&[], &[]), None);
        assert_eq!(chosen(&[5, 6, 7], &[5, 7]), Some(1));
        let turns = [(); 6].map(|()| chosen(&[5, 6, 7], &[5, 6, 7]).unwrap());
        assert_eq!(turns.map(|turn| turns.iter().filter(|other| **other == turn).count()), [2; 6]);
    }
}
