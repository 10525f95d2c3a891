//! Which component of this frame is which contact of the last: the nearest pairs first.

use super::component::Component;
use super::config::ContactConfig;
use super::label::NONE;
use super::record::Contact;
use super::track::Tracks;
use crate::format::{Fixed16, Micros};
use crate::garment::{Layout, Transform};

/// Work space: squared distances, a row per contact and a column per component.
#[derive(Debug, Clone)]
pub(super) struct Matching<const CONTACTS: usize> {
    distance: [[u32; CONTACTS]; CONTACTS],
    /// The least of each row, and its column.
    least: [(u32, u16); CONTACTS],
}

/// Out of reach.
const FAR: u32 = u32::MAX;
/// Distances are in 1/16 taxel, at most 2047 taxels: two squares fit in 32 bits.
const LONGEST: i32 = 32767;

impl<const CONTACTS: usize> Matching<CONTACTS> {
    pub const fn new() -> Self {
        Matching { distance: [[FAR; CONTACTS]; CONTACTS], least: [(FAR, 0); CONTACTS] }
    }

    /// Gives each track the index of its component, or [`NONE`].
    pub fn assign(
        &mut self,
        config: &ContactConfig,
        tracks: &mut Tracks<CONTACTS>,
        components: &[Component],
        layout: &Layout,
        now: Micros,
    ) {
        let seconds = seconds(now.since(tracks.last));
        self.least.fill((FAR, 0));
        let rows = self.distance.iter_mut().zip(&mut self.least);
        for ((row, least), (contact, trail)) in rows.zip(tracks.contacts.iter().zip(&mut tracks.trails)) {
            trail.component = NONE;
            let expected = Expected::of(contact, seconds, config.gate);
            row.fill(FAR);
            for (cell, component) in row.iter_mut().zip(components) {
                *cell = expected.distance(layout, component);
            }
            *least = least_of(row);
        }
        while let Some((track, component)) = self.nearest() {
            if let Some(trail) = tracks.trails.get_mut(track) {
                trail.component = component;
            }
            self.take(track, component);
        }
    }

    /// The pair that is nearest; of equals the oldest contact.
    fn nearest(&self) -> Option<(usize, u16)> {
        let rows = self.least.iter().enumerate().filter(|(_, (distance, _))| *distance < FAR);
        rows.min_by_key(|(_, (distance, _))| *distance).map(|(track, (_, component))| (track, *component))
    }

    /// Takes a pair out. Only the rows whose least it was need another look.
    fn take(&mut self, track: usize, component: u16) {
        for (index, (row, least)) in self.distance.iter_mut().zip(&mut self.least).enumerate() {
            if let Some(cell) = row.get_mut(usize::from(component)) {
                *cell = FAR;
            }
            if index == track {
                *least = (FAR, 0);
            } else if least.0 < FAR && least.1 == component {
                *least = least_of(row);
            }
        }
    }
}

/// The least distance of a row and its column, the first of equals.
fn least_of(row: &[u32]) -> (u32, u16) {
    let least = (0u16..).zip(row).min_by_key(|(_, distance)| **distance);
    least.map_or((FAR, 0), |(column, distance)| (*distance, column))
}

/// Microseconds as seconds in Q16, at most 16.
fn seconds(us: u64) -> i64 {
    // 2^32 * 65536 / 10^6
    ((us.min(16_000_000) * 281_474_977) >> 32) as i64
}

/// A point of a panel in 1/16 taxel: fine enough to compare distances, and 32 bits do.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub panel: u8,
    x: i32,
    y: i32,
}

impl Point {
    /// From coordinates in Q16.
    pub fn of(panel: u8, x: Fixed16, y: Fixed16) -> Point {
        Point { panel, x: x.0 >> 12, y: y.0 >> 12 }
    }

    fn through(self, way: &Transform) -> (i32, i32) {
        // As `Transform::apply`, in 32 bits: coordinates are below 2^20, and so are shifts.
        (way.xx * self.x + way.xy * self.y + way.dx * 16, way.yx * self.x + way.yy * self.y + way.dy * 16)
    }
}

/// Where a contact should be, and how far from there it may be, in 1/16 taxel.
struct Expected {
    at: Point,
    reach: u32,
}

impl Expected {
    fn of(contact: &Contact, seconds: i64, gate: u16) -> Expected {
        let gate = i32::from(gate) * 16;
        let step = |v: Fixed16| ((i64::from(v.0) * seconds) >> 28).clamp((-gate).into(), gate.into()) as i32;
        let (x, y) = (step(contact.vx), step(contact.vy));
        let at = Point::of(contact.panel, contact.x, contact.y);
        let bounds = &contact.bounds;
        let side = bounds.right.saturating_sub(bounds.left).max(bounds.bottom.saturating_sub(bounds.top));
        let reach = gate + (i32::from(side) + 1) * 8 + x.abs() + y.abs();
        Expected { at: Point { x: at.x + x, y: at.y + y, ..at }, reach: reach.min(LONGEST) as u32 }
    }

    /// Squared distance of a component, over whichever seam is shortest; [`FAR`] if out of reach.
    fn distance(&self, layout: &Layout, component: &Component) -> u32 {
        let to = Point::of(component.bounds.panel, component.x, component.y);
        match nearest_way(layout, self.at, to) {
            Some((_, squared)) if squared <= self.reach * self.reach => squared,
            _ => FAR,
        }
    }
}

/// The way between two panels (none within one panel, else over one seam) that brings a point closest to another, and
/// the squared distance that is left.
pub(super) fn nearest_way(layout: &Layout, from: Point, to: Point) -> Option<(Option<Transform>, u32)> {
    let squared = |(x, y): (i32, i32)| {
        let square = |apart: i32| (apart.clamp(-LONGEST, LONGEST).pow(2)) as u32;
        square(x - to.x) + square(y - to.y)
    };
    let mut best = (from.panel == to.panel).then(|| (None, squared((from.x, from.y))));
    let mut consider = |way: Transform| {
        let left = squared(from.through(&way));
        if best.is_none_or(|(_, least)| left < least) {
            best = Some((Some(way), left));
        }
    };
    for joint in layout.joints() {
        if (joint.b, joint.a) == (from.panel, to.panel) {
            consider(joint.b_to_a);
        }
        if (joint.a, joint.b) == (from.panel, to.panel) {
            consider(joint.b_to_a.inverse());
        }
    }
    best
}
