//! The stage: contacts on the robot, and what presses on each link.

use super::place::{SurfacePoint, rounded};
use super::pose::Pose;
use super::press::press;
use super::table::Table;
use super::{LINKS, Micrometres, UnitVector};
use crate::contact::{ContactState, Slot};
use crate::format::{Invalid, Inverse, Micros, Name, name};
use crate::garment::{Layout, PANELS};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// A contact on the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Landed {
    /// Id of the contact.
    pub id: u32,
    /// Its centroid on the surface, in the frame of the link.
    pub spot: SurfacePoint,
    /// Force of its taxels on that link, counts; those of other links count there.
    pub force: [i32; 3],
    /// The same in the frame of the poses, if the host has sent one for this link.
    pub base: Option<InBase>,
}

/// A contact in the frame of the poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct InBase {
    /// Its centroid.
    pub at: Micrometres,
    /// Direction away from the robot.
    pub normal: UnitVector,
    /// Its force, counts.
    pub force: [i32; 3],
}

/// What presses on a link, in its frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Wrench {
    /// Index of the link in the table.
    pub link: u8,
    /// Its name.
    pub name: Name,
    /// Sum of the taxels' forces, counts.
    pub force: [i32; 3],
    /// Their moment about the link's origin, counts times mm.
    pub moment: [i64; 3],
    /// Sum of their magnitudes, counts: more than that of the force where the surface is curved.
    pub pressed: u32,
    /// Centre of pressure: mean of the contacts' places, weighted by their totals.
    pub center: Micrometres,
}

/// What presses on the robot in a frame.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Pressing<const CONTACTS: usize> {
    /// The contacts with a place, in the order of their onset.
    pub contacts: Vec<Landed, CONTACTS>,
    /// The links that something presses on, in the order of the table.
    pub links: Vec<Wrench, LINKS>,
}

/// Poses of the links, by the table's order.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct SurfaceState {
    poses: [Option<Pose>; LINKS],
    told: Option<Micros>,
}

/// LinkSums of a link.
#[derive(Clone, Copy)]
struct LinkSums {
    force: [i64; 3],
    moment: [i64; 3],
    pressed: u32,
    /// Sum of place times total, of the contacts whose centroid lies on the link; and of their totals.
    places: [i64; 3],
    totals: u32,
}

impl LinkSums {
    const NONE: LinkSums = LinkSums { force: [0; 3], moment: [0; 3], pressed: 0, places: [0; 3], totals: 0 };
}

impl SurfaceState {
    /// No pose.
    pub const fn new() -> SurfaceState {
        SurfaceState { poses: [None; LINKS], told: None }
    }

    /// Takes poses of links that were in force at `at`. A refused list changes nothing.
    pub fn accept(&mut self, poses: &[(Name, Pose)], table: &Table<'_>, at: Micros) -> Result<(), Invalid> {
        let link = |called: &Name| (0u8..).take(table.links()).find(|link| table.link(*link) == Some(called));
        for (called, pose) in poses {
            pose.build()?;
            link(called).ok_or(Invalid { parameter: "pose.link", must: "must be a link of the surface" })?;
        }
        for (called, pose) in poses {
            if let Some(to) = link(called).and_then(|link| self.poses.get_mut(usize::from(link))) {
                *to = Some(*pose);
            }
        }
        self.told = Some(at);
        Ok(())
    }

    /// Time of the last poses.
    pub fn told(&self) -> Option<Micros> {
        self.told
    }

    /// Places the contacts of the last frame, and sums up what presses on each link: the pressure of their
    /// taxels before and after the filter, see `press.rs`.
    #[inline(never)] // M0+: out of line
    pub fn process<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
        &self,
        table: &Table<'_>,
        contact: &ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        [calibrated, filtered]: [&[u16]; 2],
    ) -> Pressing<CONTACTS> {
        let mut spots = [None; CONTACTS];
        for (spot, slot) in spots.iter_mut().zip(contact.present()) {
            let touch = slot.contact();
            *spot = table.spot(layout, touch.panel, touch.x, touch.y);
        }
        let links = links_of(table, layout);
        let mut forces = [[0; 3]; CONTACTS];
        let mut sums = [LinkSums::NONE; LINKS];
        for run in contact.pressed(layout) {
            let Some(link) = links.get(usize::from(run.panel)).copied().flatten() else { continue };
            let Some(sum) = sums.get_mut(usize::from(link)) else { continue };
            let last = run.first + usize::from(run.run.right - run.run.left);
            let taxels = run.first..=last;
            let values = calibrated.get(taxels.clone()).zip(filtered.get(taxels.clone()));
            let Some((values, records)) = values.zip(table.taxels().get(taxels)) else { continue };
            let mut force = [0; 3];
            let pressed = press(values, run.run.rebased(), records, (&mut force, &mut sum.moment));
            sum.pressed = sum.pressed.saturating_add(pressed);
            add(&mut sum.force, force);
            let spot = spots.get(run.contact).copied().flatten();
            if spot.is_some_and(|spot: SurfacePoint| spot.link == link)
                && let Some(to) = forces.get_mut(run.contact)
            {
                add(to, force);
            }
        }
        let mut pressing = Pressing { contacts: Vec::new(), links: Vec::new() };
        for ((slot, spot), force) in contact.present().iter().zip(spots).zip(forces) {
            let Some(spot) = spot else { continue };
            if let Some(sum) = sums.get_mut(usize::from(spot.link)) {
                sum.weigh(&spot, slot.contact().total);
            }
            // There are as many places as contacts.
            let _ = pressing.contacts.push(self.landed(slot.contact().id, spot, force.map(counts)));
        }
        for (link, sum) in (0..).zip(&sums).filter(|(_, sum)| sum.pressed > 0) {
            // There are as many places as links.
            let _ = pressing.links.push(sum.wrench(link, table.link(link).unwrap_or_default()));
        }
        pressing
    }

    #[inline(never)] // M0+: out of line
    fn landed(&self, id: u32, spot: SurfacePoint, force: [i32; 3]) -> Landed {
        let pose = self.poses.get(usize::from(spot.link)).copied().flatten();
        let base = pose.and_then(|pose| pose.build().ok()).map(|frame| InBase {
            at: frame.placed(spot.at),
            normal: frame.directed(spot.normal),
            force: frame.turned(force),
        });
        Landed { id, spot, force, base }
    }
}

impl LinkSums {
    /// Adds the place of a contact to the centre of pressure.
    fn weigh(&mut self, spot: &SurfacePoint, total: u32) {
        self.totals = self.totals.saturating_add(total);
        for (sum, at) in self.places.iter_mut().zip(spot.at) {
            *sum = sum.wrapping_add(i64::from(at) * i64::from(total));
        }
    }

    #[inline(never)] // M0+: out of line
    fn wrench(&self, link: u8, called: &str) -> Wrench {
        let inverse = Inverse::of(self.totals.max(1));
        Wrench {
            link,
            name: name(called),
            force: self.force.map(counts),
            moment: self.moment.map(|sum| against(sum.saturating_mul(1000))),
            pressed: self.pressed,
            center: self.places.map(|sum| rounded(&inverse, sum, self.totals)),
        }
    }
}

/// Link of each panel: that of its first taxel with a place.
fn links_of(table: &Table<'_>, layout: &Layout) -> [Option<u8>; PANELS] {
    let mut links = [None; PANELS];
    for (link, area) in links.iter_mut().zip(layout.areas()) {
        let taxels = table.taxels().get(usize::from(area.base)..).unwrap_or(&[]);
        let count = usize::from(area.rows) * usize::from(area.columns);
        let placed = taxels.iter().take(count).find(|taxel| taxel.is_placed());
        *link = placed.map(|taxel| taxel.link as u8);
    }
    links
}

/// A force in whole counts: at most 2^11 taxels with 2^16 counts each.
#[inline(never)] // M0+: out of line
fn counts(sum: i64) -> i32 {
    against(sum).clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// The opposite of a sum in units of 2^-14, rounded.
#[inline(never)] // M0+: out of line
fn against(sum: i64) -> i64 {
    -(sum.saturating_add(1 << 13) >> 14)
}

fn add(to: &mut [i64; 3], more: [i64; 3]) {
    for (to, more) in to.iter_mut().zip(more) {
        *to = to.wrapping_add(more);
    }
}
