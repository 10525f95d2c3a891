//! Track management: update, merge, split, release.

use super::motion::{FrameTimes, TrackInputs, Trail};
use super::slot::Slot;
use crate::format::{Fixed16, Micros, Q15};
use crate::garment::{Layout, Place, Rect};
use crate::measure::component::Component;
use crate::measure::contact::{Contact, Phase};
use crate::measure::form::measure_form;
use crate::measure::forms::Forms;
use crate::measure::frame_view::FrameView;
use crate::measure::quartic::Quartic;
use crate::segment::config::ContactConfig;
use crate::segment::labeller::Labeller;
use crate::segment::union_find::NONE;
use heapless::Vec;

/// All contacts, in the order of their onset.
#[derive(Debug, Clone)]
pub(crate) struct Tracks<const CONTACTS: usize, S = Contact> {
    pub contacts: Vec<S, CONTACTS>,
    pub trails: Vec<Trail, CONTACTS>,
    released: Vec<S, CONTACTS>,
    /// Age of the form of each contact, frames; saturates at 255.
    ages: Vec<u8, CONTACTS>,
    /// Ratios of the fourth order of each contact whose form is of this frame; 0 for the others.
    pub quartics: Vec<Quartic, CONTACTS>,
    /// Index of the first contact whose form is measured in this frame.
    turn: usize,
    id: u32,
    pub clock: FrameTimes,
}

impl<const CONTACTS: usize, S: Slot> Tracks<CONTACTS, S> {
    pub const fn new() -> Self {
        Tracks {
            contacts: Vec::new(),
            trails: Vec::new(),
            released: Vec::new(),
            ages: Vec::new(),
            quartics: Vec::new(),
            turn: 0,
            id: 0,
            clock: FrameTimes::new(),
        }
    }

    /// Releases all contacts.
    pub fn clear(&mut self) {
        for slot in &mut self.contacts {
            let contact = slot.contact_mut();
            (contact.phase, contact.total) = (Phase::Released, 0);
        }
        core::mem::swap(&mut self.contacts, &mut self.released);
        self.contacts.clear();
        self.trails.clear();
        self.ages.clear();
        self.quartics.clear();
    }

    pub fn contacts(&self) -> &[S] {
        &self.contacts
    }

    pub fn released(&self) -> &[S] {
        &self.released
    }

    pub fn ages(&self) -> &[u8] {
        &self.ages
    }

    pub fn quartics(&self) -> &[Quartic] {
        &self.quartics
    }

    /// Index of the contact that continues as `component`.
    pub fn index_of(&self, component: u16) -> Option<usize> {
        self.trails.iter().position(|trail| trail.component == component)
    }

    /// Index of the contact of each component.
    pub fn contacts_of_components(&self) -> [Option<u8>; CONTACTS] {
        const { assert!(CONTACTS <= 1 << u8::BITS, "an index has 8 bits") };
        let mut contacts = [None; CONTACTS];
        for (index, trail) in (0..=u8::MAX).zip(&self.trails) {
            if let Some(contact) = contacts.get_mut(usize::from(trail.component)) {
                *contact = Some(index);
            }
        }
        contacts
    }

    /// Handles contacts that found no component. If the last peak of such a contact lies in a component or
    /// beside it, the contact takes that component. If another contact has it already, the one with the
    /// greater total keeps it, and if the totals are equal, the one that was matched by distance.
    pub fn merge<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &Labeller<RUNS, LABELS>,
        layout: &Layout,
    ) {
        for index in 0..self.contacts.len() {
            let lost = self.trails.get(index).is_some_and(|trail| trail.component == NONE);
            let Some(contact) = self.contacts.get(index).filter(|_| lost).map(S::contact) else { continue };
            let Some(component) = beside(labeller, layout, contact.peak_at) else { continue };
            let owner = self.index_of(component);
            let rival = owner.and_then(|owner| self.contacts.get(owner)).map(S::contact);
            let stays = rival.is_some_and(|rival| rival.total >= contact.total);
            match owner {
                Some(owner) if stays => self.leap(owner),
                Some(owner) => self.set_component(owner, NONE),
                None => {}
            }
            if !stays {
                self.set_component(index, component);
                self.leap(index);
            }
        }
    }

    fn set_component(&mut self, index: usize, component: u16) {
        if let Some(trail) = self.trails.get_mut(index) {
            trail.component = component;
        }
    }

    fn leap(&mut self, index: usize) {
        if let Some(trail) = self.trails.get_mut(index) {
            trail.leaps = true;
        }
    }

    /// Updates all contacts: follows, releases and begins them.
    pub fn update<const RUNS: usize, const LABELS: usize>(
        &mut self,
        config: &ContactConfig,
        components: &[Component],
        view: &FrameView<'_, RUNS, LABELS>,
        (now, forms): (Micros, Forms),
    ) {
        let inputs = TrackInputs { config, layout: view.layout, pace: self.clock.tick(config, now) };
        let known = self.known();
        self.part(components, &known);
        self.released.clear();
        for (slot, trail) in self.contacts.iter_mut().zip(&mut self.trails) {
            let contact = slot.contact_mut();
            match components.get(usize::from(trail.component)) {
                Some(component) => {
                    trail.follow(contact, component, &inputs);
                    describe(contact, component);
                    contact.phase = Phase::Held;
                    contact.duration_ms = now.millis_since(contact.onset);
                }
                None => {
                    (contact.phase, contact.total) = (Phase::Released, 0);
                    contact.duration_ms = now.millis_since(contact.onset);
                    // Always room: as many places as contacts.
                    let _ = self.released.push(slot.clone());
                }
            }
        }
        let trails = &self.trails;
        let mut index = 0;
        self.contacts.retain(|_| {
            index += 1;
            trails.get(index - 1).is_some_and(|trail| trail.component != NONE)
        });
        self.trails.retain(|trail| trail.component != NONE);
        let held = self.contacts.len();
        for (index, component) in (0u16..).zip(components) {
            if is_new(&known, index, component) {
                self.begin(index, component, now);
            }
        }
        self.look(held, forms, components, view);
    }

    /// Measures the form of new contacts, and of as many of the `held` older ones as have their turn.
    fn look<const RUNS: usize, const LABELS: usize>(
        &mut self,
        held: usize,
        forms: Forms,
        components: &[Component],
        view: &FrameView<'_, RUNS, LABELS>,
    ) {
        let (next, count) = (self.turn + forms.in_frame(), forms.in_frame());
        self.turn = if next < held { next } else { 0 };
        self.ages.clear();
        self.quartics.clear();
        for (index, (slot, trail)) in self.contacts.iter_mut().zip(&mut self.trails).enumerate() {
            let due = index.wrapping_sub(self.turn) < count || index >= held;
            trail.age = if due { 0 } else { trail.age.saturating_add(1) };
            // Always room: as many places as contacts.
            let _ = self.ages.push(trail.age);
            let Some(component) = components.get(usize::from(trail.component)).filter(|_| due) else {
                let _ = self.quartics.push(Quartic::default());
                continue;
            };
            let contact = slot.contact_mut();
            let _ = self.quartics.push(measure_form(view, contact, trail.component, component));
            if contact.total >= trail.looked {
                (trail.looked, contact.peak_breadth) = (contact.total, contact.breadth);
            }
        }
    }

    /// Component of a contact.
    pub fn component_of(&self, contact: usize) -> Option<u16> {
        self.trails.get(contact).map(|trail| trail.component).filter(|component| *component != NONE)
    }

    /// Renumbers components after `lost`, which was unassigned, is removed: those after it move up.
    pub fn renumber(&mut self, lost: u16) {
        for trail in self.trails.iter_mut().filter(|trail| trail.component != NONE && trail.component > lost)
        {
            trail.component -= 1;
        }
    }

    /// Flags the components that are assigned to a contact.
    pub fn known(&self) -> [bool; CONTACTS] {
        let mut known = [false; CONTACTS];
        for trail in &self.trails {
            if let Some(known) = known.get_mut(usize::from(trail.component)) {
                *known = true;
            }
        }
        known
    }

    /// Marks the contacts that split: a new component peaks within their box.
    fn part(&mut self, components: &[Component], known: &[bool]) {
        for (index, component) in (0u16..).zip(components) {
            let Some(at) = component.peak_at.filter(|_| is_new(known, index, component)) else {
                continue;
            };
            for (slot, trail) in self.contacts.iter().zip(&mut self.trails) {
                trail.leaps |= slot.contact().bounds.holds(at.panel, at.row, at.column, 0);
            }
        }
    }

    fn begin(&mut self, index: u16, component: &Component, now: Micros) {
        self.id = self.id.checked_add(1).unwrap_or(1);
        let mut contact = Contact {
            id: self.id,
            phase: Phase::Onset,
            panel: 0,
            total: 0,
            peak: 0,
            peak_at: Place { panel: 0, row: 0, column: 0 },
            area: 0,
            perimeter: 0,
            edge: 0,
            bounds: Rect { panel: 0, top: 0, bottom: 0, left: 0, right: 0 },
            x: Fixed16(0),
            y: Fixed16(0),
            azimuth: None,
            anisotropy: Q15(0),
            breadth: 0,
            peak_breadth: 0,
            dx: Fixed16(0),
            dy: Fixed16(0),
            vx: Fixed16(0),
            vy: Fixed16(0),
            slip: false,
            onset: now,
            duration_ms: 0,
            peak_total: 0,
        };
        describe(&mut contact, component);
        // There are no more contacts than components, and both lists have the same capacity.
        if self.contacts.push(S::from(contact)).is_ok() {
            let _ = self.trails.push(Trail::new(index));
        }
    }
}

/// True if a new contact begins with a component. A faint component only continues a contact: it is a
/// splinter of one that lifts.
fn is_new(known: &[bool], index: u16, component: &Component) -> bool {
    component.begins && known.get(usize::from(index)) == Some(&false)
}

/// Returns the contact of a taxel or, if it has none, of one of its eight neighbours in the panel.
fn beside<const RUNS: usize, const LABELS: usize>(
    labeller: &Labeller<RUNS, LABELS>,
    layout: &Layout,
    place: Place,
) -> Option<u16> {
    let area = layout.areas().get(usize::from(place.panel))?;
    let around = |at: u16| [at, at.wrapping_sub(1), at.saturating_add(1)];
    let places =
        around(place.row).into_iter().flat_map(|row| around(place.column).map(|column| (row, column)));
    places
        .filter(|(row, column)| *row < area.rows && *column < area.columns)
        .find_map(|(row, column)| labeller.contact_at(area, row, column))
}

/// Copies the measures that need no history, without the form.
fn describe(contact: &mut Contact, component: &Component) {
    contact.panel = component.bounds.panel;
    contact.total = component.total;
    contact.peak = component.peak;
    contact.peak_at = component.peak_at.unwrap_or(contact.peak_at);
    contact.area = component.area;
    contact.bounds = component.bounds;
    (contact.x, contact.y) = (component.x, component.y);
    contact.peak_total = contact.peak_total.max(component.total);
}
