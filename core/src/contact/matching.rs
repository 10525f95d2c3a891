//! Which component of this frame is which contact of the last: the nearest pairs first.

use super::component::Component;
use super::config::ContactConfig;
use super::point::{Images, LONGEST, Point};
use super::record::Contact;
use super::run::NONE;
use super::track::Tracks;
use super::trail::Trail;
use crate::format::{Fixed16, Micros, signed_wide, wide};
use crate::garment::{Layout, PANELS};
use core::ops::Range;
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
        let crowds = crowds(&self.points);
        let rows = self.distance.iter_mut().zip(&mut self.least);
        for ((row, least), (contact, trail)) in rows.zip(tracks.contacts.iter().zip(&mut tracks.trails)) {
            trail.component = NONE;
            let (at, reach) = expected(contact, seconds, config.gate);
            at.list_images(layout, &mut self.expected);
            *least = distances(&self.expected, &self.points, &crowds, reach, row);
        }
        if self.is_settled(&mut tracks.trails) {
            return;
        }
        while let Some((track, component)) = self.nearest() {
            if let Some(trail) = tracks.trails.get_mut(track) {
                trail.component = component;
            }
            self.take(track, component);
        }
    }

    /// Where each contact has another component nearest, as mostly, that is its own, whichever pair is taken first.
    fn is_settled(&mut self, trails: &mut [Trail]) -> bool {
        let nearest =
            || self.least.iter().take(self.used.0).map(|(distance, at)| (*distance < FAR).then_some(at));
        for component in nearest().flatten() {
            match self.taken.get_mut(usize::from(*component)) {
                Some(taken) if !*taken => *taken = true,
                _ => {
                    self.taken.fill(false);
                    return false;
                }
            }
        }
        for (trail, component) in trails.iter_mut().zip(nearest()) {
            trail.component = component.copied().unwrap_or(NONE);
        }
        true
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

/// The points on a panel.
#[derive(Debug, Clone)]
struct Crowd {
    /// From which to which they are; points of other panels may be between them.
    span: Range<usize>,
    /// The rectangle around them.
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

impl Crowd {
    const NONE: Crowd =
        Crowd { span: 0..0, left: i32::MAX, right: i32::MIN, top: i32::MAX, bottom: i32::MIN };

    /// Whether one of them may be within reach of a point.
    fn is_near(&self, point: &Point, reach: i32) -> bool {
        let near = |at: i32, from: i32, to: i32| at + reach >= from && at - reach <= to;
        near(point.x, self.left, self.right) && near(point.y, self.top, self.bottom)
    }
}

/// The points of each panel.
fn crowds(points: &[Point]) -> [Crowd; PANELS] {
    let mut crowds = [const { Crowd::NONE }; PANELS];
    for (index, point) in points.iter().enumerate() {
        if let Some(crowd) = crowds.get_mut(usize::from(point.panel)) {
            crowd.span = if crowd.span.end == 0 { index } else { crowd.span.start }..index + 1;
            (crowd.left, crowd.right) = (crowd.left.min(point.x), crowd.right.max(point.x));
            (crowd.top, crowd.bottom) = (crowd.top.min(point.y), crowd.bottom.max(point.y));
        }
    }
    crowds
}

/// Squared distances of some points from the nearest of the images, [`FAR`] if out of reach; the least of them, and the first
/// point that has it.
#[inline(never)] // the few registers of an M0+ are for this
fn distances(
    images: &Images,
    points: &[Point],
    crowds: &[Crowd; PANELS],
    reach: u32,
    row: &mut [u32],
) -> (u32, u16) {
    row.iter_mut().take(points.len()).for_each(|cell| *cell = FAR);
    let mut least = (FAR, 0);
    for image in images {
        let Some(crowd) = crowds.get(usize::from(image.panel)) else { continue };
        if !crowd.is_near(image, reach as i32) {
            continue;
        }
        let span = &crowd.span;
        let (Some(row), Some(points)) = (row.get_mut(span.clone()), points.get(span.clone())) else {
            continue;
        };
        for ((cell, point), column) in row.iter_mut().zip(points).zip(span.start as u16..) {
            if point.panel != image.panel {
                continue;
            }
            let x = (image.x - point.x).unsigned_abs();
            // Most pairs are told apart by this.
            if x > reach {
                continue;
            }
            let y = (image.y - point.y).unsigned_abs();
            if y > reach {
                continue;
            }
            // No reach is longer than LONGEST.
            let squared = x * x + y * y;
            if squared <= reach * reach && squared < *cell {
                *cell = squared;
                least = least.min((squared, column));
            }
        }
    }
    least
}
