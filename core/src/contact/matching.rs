//! Which component of this frame is which contact of the last: the nearest pairs first.

use super::component::Component;
use super::config::ContactConfig;
use super::point::{Images, LONGEST, Point};
use super::record::Contact;
use super::run::NONE;
use super::track::Tracks;
use crate::format::{Fixed16, Micros, signed_wide, wide};
use crate::garment::Layout;
use heapless::Vec;

/// Work space: squared distances, a row per contact and a column per component.
#[derive(Debug, Clone)]
pub(super) struct Matching<const CONTACTS: usize> {
    distance: [[u32; CONTACTS]; CONTACTS],
    /// The least of each row, and its column.
    least: [(u32, u16); CONTACTS],
    /// Where the components are.
    points: Vec<Point, CONTACTS>,
    /// Where a contact should be, on its own panel and as seen from others.
    expected: Images,
    /// Components that have found their contact.
    taken: [bool; CONTACTS],
    /// Rows and columns in use.
    used: (usize, usize),
}

/// Out of reach.
const FAR: u32 = u32::MAX;

impl<const CONTACTS: usize> Matching<CONTACTS> {
    pub const fn new() -> Self {
        Matching {
            distance: [[FAR; CONTACTS]; CONTACTS],
            least: [(FAR, 0); CONTACTS],
            points: Vec::new(),
            expected: Images::new(),
            taken: [false; CONTACTS],
            used: (0, 0),
        }
    }

    /// Gives each track the index of its component, or [`NONE`].
    #[inline(never)] // a stack frame of its own is near
    pub fn assign(
        &mut self,
        config: &ContactConfig,
        tracks: &mut Tracks<CONTACTS>,
        components: &[Component],
        layout: &Layout,
        now: Micros,
    ) {
        let seconds = seconds(now.since(tracks.clock.last()));
        self.used = (tracks.contacts.len(), components.len());
        self.taken.fill(false);
        self.points.clear();
        for component in components {
            let _ = self.points.push(Point::of(component.bounds.panel, component.x, component.y));
        }
        let rows = self.distance.iter_mut().zip(&mut self.least);
        for ((row, least), (contact, trail)) in rows.zip(tracks.contacts.iter().zip(&mut tracks.trails)) {
            trail.component = NONE;
            let (at, reach) = expected(contact, seconds, config.gate);
            at.list_images(layout, &mut self.expected);
            *least = (FAR, 0);
            for ((cell, point), column) in row.iter_mut().zip(&self.points).zip(0..) {
                *cell = distance(&self.expected, point, reach);
                if *cell < least.0 {
                    *least = (*cell, column);
                }
            }
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
        let rows =
            self.least.iter().take(self.used.0).enumerate().filter(|(_, (distance, _))| *distance < FAR);
        rows.min_by_key(|(_, (distance, _))| *distance).map(|(track, (_, component))| (track, *component))
    }

    /// Takes a pair out. Only the rows whose least it was need another look.
    fn take(&mut self, track: usize, component: u16) {
        if let Some(least) = self.least.get_mut(track) {
            *least = (FAR, 0);
        }
        let (rows, columns) = self.used;
        if let Some(taken) = self.taken.get_mut(usize::from(component)) {
            *taken = true;
        }
        for (row, least) in self.distance.iter().zip(&mut self.least).take(rows) {
            if least.1 == component && least.0 < FAR {
                *least = least_of(row.get(..columns).unwrap_or(row), &self.taken);
            }
        }
    }
}

/// The least distance of a row to what is not taken, and its column, the first of equals.
fn least_of(row: &[u32], taken: &[bool]) -> (u32, u16) {
    let free = (0u16..).zip(row.iter().zip(taken)).filter(|(_, (_, taken))| !**taken);
    let least = free.min_by_key(|(_, (distance, _))| **distance);
    least.map_or((FAR, 0), |(column, (distance, _))| (*distance, column))
}

/// Microseconds as seconds in Q16, at most 16.
fn seconds(us: u64) -> u32 {
    // 2^32 * 65536 / 10^6
    (wide(us.min(16_000_000) as u32, 281_474_977) >> 32) as u32
}

/// Where a contact should be, and how far from there it may be, in 1/16 taxel.
fn expected(contact: &Contact, seconds: u32, gate: u16) -> (Point, u32) {
    let gate = i32::from(gate) * 16;
    let step = |v: Fixed16| (signed_wide(v.0, seconds) >> 28).clamp((-gate).into(), gate.into()) as i32;
    let still = contact.vx.0 == 0 && contact.vy.0 == 0;
    let (x, y) = if still { (0, 0) } else { (step(contact.vx), step(contact.vy)) };
    let at = Point::of(contact.panel, contact.x, contact.y);
    let bounds = &contact.bounds;
    let side = bounds.right.saturating_sub(bounds.left).max(bounds.bottom.saturating_sub(bounds.top));
    let reach = gate + (i32::from(side) + 1) * 8 + x.abs() + y.abs();
    (Point { x: at.x + x, y: at.y + y, ..at }, reach.min(LONGEST) as u32)
}

/// Squared distance of a point from the nearest of the images; [`FAR`] if out of reach.
fn distance(images: &Images, to: &Point, reach: u32) -> u32 {
    let mut least = FAR;
    for image in images.iter().filter(|image| image.panel == to.panel) {
        let apart = |a: i32, b: i32| (a - b).unsigned_abs().min(LONGEST as u32);
        let x = apart(image.x, to.x);
        // Most pairs are told apart by this.
        if x > reach {
            continue;
        }
        let y = apart(image.y, to.y);
        let squared = x * x + y * y;
        if squared < least && squared <= reach * reach {
            least = squared;
        }
    }
    least
}
