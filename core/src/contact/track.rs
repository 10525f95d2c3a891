//! Contacts over time: identity, way, velocity, slip.
//!
//! A contact that two become keeps the id of the older one, even if the younger is nearer: the older is known by the taxel
//! that was its peak, or one beside it. Of a contact that falls apart the nearest part keeps the id.

use super::axis::axis_and_breadth;
use super::component::Component;
use super::config::ContactConfig;
use super::label::Labels;
use super::moments::Moments;
use super::point::{Point, nearest_way};
use super::record::{Contact, Phase};
use super::run::NONE;
use crate::format::{Fixed16, Inverse, Micros, Q15};
use crate::garment::{Layout, Place, Rect, Transform};
use heapless::Vec;

/// Consecutive frames above the slip speed that make a slip.
const SLIP_FRAMES: u8 = 3;
/// Way since onset that a slip needs: half a taxel.
const SLIP_WAY: Fixed16 = Fixed16(1 << 15);

/// What is remembered of a contact beside what is told.
#[derive(Debug, Clone)]
pub(super) struct Trail {
    /// Index of its component in this frame, or [`NONE`].
    pub component: u16,
    /// Frames in a row above the slip speed.
    fast: u8,
}

/// All contacts, in the order of their onset.
#[derive(Debug, Clone)]
pub(super) struct Tracks<const CONTACTS: usize> {
    pub contacts: Vec<Contact, CONTACTS>,
    pub trails: Vec<Trail, CONTACTS>,
    moments: Vec<Moments, CONTACTS>,
    released: Vec<Contact, CONTACTS>,
    id: u32,
    /// Time of the last frame.
    pub last: Micros,
}

impl<const CONTACTS: usize> Tracks<CONTACTS> {
    pub const fn new() -> Self {
        Tracks {
            contacts: Vec::new(),
            trails: Vec::new(),
            moments: Vec::new(),
            released: Vec::new(),
            id: 0,
            last: Micros(0),
        }
    }

    pub fn clear(&mut self) {
        self.contacts.clear();
        self.trails.clear();
        self.moments.clear();
        self.released.clear();
    }

    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    pub fn moments(&self) -> &[Moments] {
        &self.moments
    }

    pub fn released(&self) -> &[Contact] {
        &self.released
    }

    /// Index of the contact that a component became.
    pub fn index_of(&self, component: u16) -> Option<usize> {
        self.trails.iter().position(|trail| trail.component == component)
    }

    /// Contacts that found no component, but whose last peak lies in one or beside it, take it over from a younger contact.
    pub fn merge<const RUNS: usize>(&mut self, labels: &Labels<RUNS>, layout: &Layout) {
        for index in 0..self.contacts.len() {
            let lost = self.trails.get(index).is_some_and(|trail| trail.component == NONE);
            let Some(contact) = self.contacts.get(index).filter(|_| lost) else { continue };
            let Some(component) = beside(labels, layout, contact.peak_at) else { continue };
            match self.index_of(component) {
                Some(owner) if owner < index => continue,
                Some(owner) => self.set_component(owner, NONE),
                None => {}
            }
            self.set_component(index, component);
        }
    }

    fn set_component(&mut self, index: usize, component: u16) {
        if let Some(trail) = self.trails.get_mut(index) {
            trail.component = component;
        }
    }

    /// Brings all contacts up to date.
    pub fn update(&mut self, config: &ContactConfig, components: &[Component], layout: &Layout, now: Micros) {
        let pace = Pace::of(config, now.since(self.last));
        self.last = now;
        self.released.clear();
        for (contact, trail) in self.contacts.iter_mut().zip(&mut self.trails) {
            match components.get(usize::from(trail.component)) {
                Some(component) => {
                    follow(contact, trail, component, config, layout, &pace);
                    contact.duration_ms = now.millis_since(contact.onset);
                }
                None => {
                    let duration_ms = now.millis_since(contact.onset);
                    let gone = Contact { phase: Phase::Released, total: 0, duration_ms, ..contact.clone() };
                    // As many places as contacts.
                    let _ = self.released.push(gone);
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
        for (index, component) in (0u16..).zip(components) {
            // A faint one goes on as what it was, but begins nothing: it is a splinter of a contact that lifts.
            if component.peak >= config.high && self.index_of(index).is_none() {
                self.begin(index, component, layout, now);
            }
        }
        self.moments.clear();
        for trail in &self.trails {
            if let Some(component) = components.get(usize::from(trail.component)) {
                let _ = self.moments.push(component.moments);
            }
        }
    }

    fn begin(&mut self, index: u16, component: &Component, layout: &Layout, now: Micros) {
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
        describe(&mut contact, component, layout);
        // There are no more contacts than components, and both lists have the same capacity.
        if self.contacts.push(contact).is_ok() {
            let _ = self.trails.push(Trail { component: index, fast: 0 });
        }
    }
}

/// The contact that a place belongs to, or one of its eight neighbours in the panel.
fn beside<const RUNS: usize>(labels: &Labels<RUNS>, layout: &Layout, place: Place) -> Option<u16> {
    let area = layout.areas().get(usize::from(place.panel))?;
    let around = |at: u16| [at, at.wrapping_sub(1), at.saturating_add(1)];
    let places =
        around(place.row).into_iter().flat_map(|row| around(place.column).map(|column| (row, column)));
    places
        .filter(|(row, column)| *row < area.rows && *column < area.columns)
        .find_map(|(row, column)| labels.contact_at(area, row, column))
}

/// What the frame alone tells.
fn describe(contact: &mut Contact, component: &Component, layout: &Layout) {
    let panel = component.bounds.panel;
    let pitch = layout.areas().get(usize::from(panel)).map_or([0, 0], |area| area.pitch_um);
    let (axis, breadth) = axis_and_breadth(&component.moments, component.area.into(), pitch);
    contact.panel = panel;
    contact.total = component.total;
    contact.peak = component.peak;
    contact.peak_at = component.peak_at.unwrap_or(contact.peak_at);
    contact.area = component.area;
    contact.perimeter = component.contour.length as u16;
    contact.edge =
        component.contour.slope.checked_div(component.contour.length).unwrap_or(0).min(0xffff) as u16;
    contact.bounds = component.bounds;
    (contact.x, contact.y) = (component.x, component.y);
    (contact.azimuth, contact.anisotropy) = (axis.azimuth, axis.anisotropy);
    contact.breadth = breadth;
    if component.total >= contact.peak_total {
        (contact.peak_total, contact.peak_breadth) = (component.total, contact.breadth);
    }
}

/// What it tells together with the last one.
fn follow(
    contact: &mut Contact,
    trail: &mut Trail,
    component: &Component,
    config: &ContactConfig,
    layout: &Layout,
    pace: &Pace,
) {
    let from = Point::of(contact.panel, contact.x, contact.y);
    let to = Point::of(component.bounds.panel, component.x, component.y);
    let way = nearest_way(layout, from, to).and_then(|(way, _)| way).unwrap_or(Transform::IDENTITY);
    let carried = |x: Fixed16, y: Fixed16, one| way.apply(x.0.into(), y.0.into(), one);
    let (x, y) = carried(contact.x, contact.y, 1 << 16);
    let (dx, dy) = carried(contact.dx, contact.dy, 0);
    let (vx, vy) = carried(contact.vx, contact.vy, 0);
    let (step_x, step_y) = (i64::from(component.x.0) - x, i64::from(component.y.0) - y);
    describe(contact, component, layout);
    contact.phase = Phase::Held;
    (contact.dx, contact.dy) = (Fixed16::saturating(dx + step_x), Fixed16::saturating(dy + step_y));
    contact.vx = pace.velocity(vx, step_x);
    contact.vy = pace.velocity(vy, step_y);
    let fast = length_squared(contact.vx, contact.vy, 12) >= u64::from(config.slip_speed).pow(2);
    trail.fast = if fast { trail.fast.saturating_add(1) } else { 0 };
    let away = length_squared(contact.dx, contact.dy, 8) >= length_squared(SLIP_WAY, Fixed16(0), 8);
    contact.slip = trail.fast >= SLIP_FRAMES && away;
}

/// How a step becomes a velocity in this frame.
struct Pace {
    /// Time constant, us; below 2^26.
    tau: i64,
    /// Of `tau` and the time since the last frame; none where no time went by.
    inverse: Option<Inverse>,
}

impl Pace {
    fn of(config: &ContactConfig, elapsed: u64) -> Pace {
        let tau = u32::from(config.smoothing_ms) * 1000;
        let inverse = (elapsed > 0).then(|| Inverse::of(tau + elapsed.min(1 << 31) as u32));
        Pace { tau: tau.into(), inverse }
    }

    /// `v + (step / dt - v) dt / (tau + dt)` as `(v tau + step) / (tau + dt)`: a first-order low pass over the real time
    /// between the frames.
    fn velocity(&self, v: i64, step: i64) -> Fixed16 {
        match self.inverse {
            // 32 + 26 bits and 34 + 20 bits: no overflow.
            Some(inverse) => Fixed16(inverse.nearest(v * self.tau + step * 1_000_000)),
            None => Fixed16::saturating(v),
        }
    }
}

fn length_squared(x: Fixed16, y: Fixed16, shift: u32) -> u64 {
    let square = |v: Fixed16| u64::from(v.0.unsigned_abs() >> shift).pow(2);
    square(x) + square(y)
}
