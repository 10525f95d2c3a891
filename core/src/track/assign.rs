//! Assignment of this frame's components to the last frame's contacts: the nearest pairs first.

use super::point::{LONGEST, PanelPoint, PointImages};
use super::slot::Slot;
use super::tracks::Tracks;
use crate::format::{Fixed16, Micros, signed_wide, wide};
use crate::garment::{Layout, PANELS};
use crate::measure::component::Component;
use crate::measure::contact::Contact;
use crate::segment::config::ContactConfig;
use crate::segment::union_find::NONE;
use core::ops::Range;
use heapless::Vec;

/// Work space of the assignment.
#[derive(Debug, Clone)]
pub(crate) struct Matching<const CONTACTS: usize> {
    /// Per contact: (squared distance, index) of the nearest free component; [`FAR`] outside the gate; ties
    /// go to the lower index.
    least: [(u32, u16); CONTACTS],
    /// Centroids of the components.
    points: Vec<PanelPoint, CONTACTS>,
    /// Expected position of a contact, on its own panel and as seen from others.
    expected: PointImages,
    /// Components that are assigned.
    taken: [bool; CONTACTS],
}

/// Distance of a component outside the gate.
const FAR: u32 = u32::MAX;

impl<const CONTACTS: usize> Matching<CONTACTS> {
    pub const fn new() -> Self {
        Matching {
            least: [(0, 0); CONTACTS],
            points: Vec::new(),
            expected: PointImages::new(),
            taken: [false; CONTACTS],
        }
    }

    /// Assigns to each track the index of its component, or [`NONE`].
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub fn assign<S: Slot>(
        &mut self,
        config: &ContactConfig,
        tracks: &mut Tracks<CONTACTS, S>,
        components: &[Component],
        layout: &Layout,
        now: Micros,
    ) {
        let seconds = seconds(now.since(tracks.clock.last()));
        self.taken.fill(false);
        self.points.clear();
        for component in components {
            let _ = self.points.push(PanelPoint::of(component.bounds.panel, component.x, component.y));
        }
        let mut crowds = [const { Crowd::NONE }; PANELS];
        gather(&mut crowds, &self.points);
        let Tracks { contacts, trails, .. } = tracks;
        let (points, taken, images) = (&self.points, &mut self.taken, &mut self.expected);
        let mut look = |contact: &Contact, taken: &[bool]| {
            let area = layout.areas().get(usize::from(contact.panel));
            let gate = area.map_or(0, |area| area.taxels(16 * u32::from(config.gate)));
            let (at, reach) = expected(contact, seconds, gate as i32);
            at.list_images(layout, images);
            nearest(images, points, &crowds, reach, taken)
        };
        for (least, slot) in self.least.iter_mut().zip(&*contacts) {
            *least = look(slot.contact(), taken);
        }
        let least = self.least.get_mut(..contacts.len()).unwrap_or(&mut []);
        for (trail, least) in trails.iter_mut().zip(&*least) {
            trail.component = if least.0 < FAR { least.1 } else { NONE };
        }
        if are_distinct(least, taken) {
            // The usual case: no two contacts are nearest to the same component.
            return;
        }
        taken.fill(false);
        trails.iter_mut().for_each(|trail| trail.component = NONE);
        while let Some((track, component)) = nearest_pair(least) {
            if let Some(trail) = trails.get_mut(track) {
                trail.component = component;
            }
            if let Some(taken) = taken.get_mut(usize::from(component)) {
                *taken = true;
            }
            for (index, (least, slot)) in least.iter_mut().zip(&*contacts).enumerate() {
                if index == track {
                    *least = (FAR, 0);
                } else if least.1 == component && least.0 < FAR {
                    *least = look(slot.contact(), taken);
                }
            }
        }
    }
}

/// True if no two contacts are nearest to the same component. Marks the components up to the first conflict.
fn are_distinct(least: &[(u32, u16)], taken: &mut [bool]) -> bool {
    let mut within = least.iter().filter(|(distance, _)| *distance < FAR);
    within.all(|(_, component)| {
        taken.get_mut(usize::from(*component)).is_some_and(|taken| !core::mem::replace(taken, true))
    })
}

/// Returns the nearest pair of contact and component; of equal pairs that of the oldest contact.
fn nearest_pair(least: &[(u32, u16)]) -> Option<(usize, u16)> {
    let within = least.iter().enumerate().filter(|(_, (distance, _))| *distance < FAR);
    within.min_by_key(|(_, (distance, _))| *distance).map(|(track, (_, component))| (track, *component))
}

/// Microseconds as seconds in Q16, at most 16.
fn seconds(us: u64) -> u32 {
    // 2^32 * 65536 / 10^6
    (wide(us.min(16_000_000) as u32, 281_474_977) >> 32) as u32
}

/// Returns the expected position of a contact and its search radius; radius and `gate` in 1/16 taxel.
fn expected(contact: &Contact, seconds: u32, gate: i32) -> (PanelPoint, u32) {
    let step = |v: Fixed16| (signed_wide(v.0, seconds) >> 28).clamp((-gate).into(), gate.into()) as i32;
    let still = contact.vx.0 == 0 && contact.vy.0 == 0;
    let (x, y) = if still { (0, 0) } else { (step(contact.vx), step(contact.vy)) };
    let at = PanelPoint::of(contact.panel, contact.x, contact.y);
    let bounds = &contact.bounds;
    let side = bounds.right.saturating_sub(bounds.left).max(bounds.bottom.saturating_sub(bounds.top));
    let reach = gate + (i32::from(side) + 1) * 8 + x.abs() + y.abs();
    (PanelPoint { x: at.x + x, y: at.y + y, ..at }, reach.min(LONGEST) as u32)
}

/// The points on one panel.
#[derive(Debug, Clone)]
struct Crowd {
    /// Range of their indices; points of other panels may lie between them.
    span: Range<usize>,
    /// Their bounding box.
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

impl Crowd {
    const NONE: Crowd =
        Crowd { span: 0..0, left: i32::MAX, right: i32::MIN, top: i32::MAX, bottom: i32::MIN };

    /// True if one of them may be within reach of a point.
    fn is_near(&self, point: &PanelPoint, reach: i32) -> bool {
        let near = |at: i32, from: i32, to: i32| at + reach >= from && at - reach <= to;
        near(point.x, self.left, self.right) && near(point.y, self.top, self.bottom)
    }
}

/// Collects the points of each panel.
fn gather(crowds: &mut [Crowd; PANELS], points: &[PanelPoint]) {
    for (index, point) in points.iter().enumerate() {
        if let Some(crowd) = crowds.get_mut(usize::from(point.panel)) {
            crowd.span = if crowd.span.end == 0 { index } else { crowd.span.start }..index + 1;
            (crowd.left, crowd.right) = (crowd.left.min(point.x), crowd.right.max(point.x));
            (crowd.top, crowd.bottom) = (crowd.top.min(point.y), crowd.bottom.max(point.y));
        }
    }
}

/// Returns the least squared distance from a free point to any of the images, and the first point that has
/// it; [`FAR`] if none is within reach.
#[inline(never)] // M0+: out of line
fn nearest(
    images: &PointImages,
    points: &[PanelPoint],
    crowds: &[Crowd; PANELS],
    mut reach: u32,
    taken: &[bool],
) -> (u32, u16) {
    let mut least = (FAR, 0);
    for image in images {
        let Some(crowd) = crowds.get(usize::from(image.panel)) else { continue };
        if !crowd.is_near(image, reach as i32) {
            continue;
        }
        let points = points.get(crowd.span.clone()).unwrap_or(&[]);
        for (point, column) in points.iter().zip(crowd.span.start as u16..) {
            let x = (image.x - point.x).unsigned_abs();
            // Rejects most pairs.
            if x > reach || point.panel != image.panel {
                continue;
            }
            let y = (image.y - point.y).unsigned_abs();
            if y > reach || taken.get(usize::from(column)) == Some(&true) {
                continue;
            }
            // Fits: no reach exceeds LONGEST.
            let squared = x * x + y * y;
            if squared <= reach * reach {
                least = least.min((squared, column));
                // A point farther than this along one axis cannot be nearer.
                reach = reach.min(x + y);
            }
        }
    }
    least
}
