//! The stage: contacts on the robot, and what presses on each link.

use super::frames::LinkFrames;
use super::place::SurfacePoint;
use super::press::{BATCH, NO_RECORD, PressSums, PressedImage};
use super::table::Table;
use super::taxel::TaxelRecord;
use super::uncertainty::{BlindTaxel, Uncertainty, distance, most_at, of_faulty};
use super::{LINKS, LinkName, Micrometres, UnitVector};
use crate::contact::{ContactState, Slot};
use crate::format::{Inverse, signed_wide};
use crate::garment::{Layout, PANELS, Place};
use crate::health::{FAULTY_TAXELS, FaultyTaxel};
use crate::segment::run::Run;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// A contact on the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Landed {
    /// Id of the contact.
    pub id: u32,
    /// Centroid on the surface, in the frame of the link.
    pub spot: SurfacePoint,
    /// Force of its taxels on that link, counts; those of other links count there.
    pub force: [i32; 3],
    /// Contact in the frame of the poses, if the host has sent one for this link.
    pub base: Option<InBase>,
}

/// A contact in the frame of the poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct InBase {
    /// Centroid of the contact.
    pub at: Micrometres,
    /// Direction away from the robot.
    pub normal: UnitVector,
    /// Force of the contact, counts.
    pub force: [i32; 3],
}

/// Force and moment on a link, in its frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Wrench<Called = LinkName> {
    /// Index of the link in the table.
    pub link: u8,
    /// Name of the link.
    pub name: Called,
    /// Sum of the taxels' forces, counts.
    pub force: [i32; 3],
    /// Their moment about the link's origin, counts times mm.
    pub moment: [i64; 3],
    /// Sum of their magnitudes, counts: more than that of the force where the surface is curved.
    pub pressed: u32,
    /// Centre of pressure: mean of the contacts' places, weighted by their totals.
    pub center: Micrometres,
}

/// Contacts and forces on the robot in a frame.
#[derive(Debug)]
pub struct Pressing<const CONTACTS: usize> {
    /// The contacts with a place, in the order of their onset.
    landings: Vec<Landing, CONTACTS>,
    /// Sums of all links, and the numbers of those that something presses on.
    sums: [LinkSums; LINKS],
    pressed: Vec<u8, LINKS>,
    /// Faulty taxels under contacts or at their edges.
    blind: Vec<BlindTaxel, FAULTY_TAXELS>,
    /// Number of saturated taxels of each present contact.
    saturated: [u16; CONTACTS],
}

/// Limits of the taxels, beside their pressure.
pub struct TaxelLimits<'a, Ceiling> {
    /// Taxels that feel nothing.
    pub faulty: &'a [FaultyTaxel],
    /// Pressure of a taxel at the end of the converter's range, counts.
    pub ceiling: Ceiling,
}

/// A contact with a place.
#[derive(Debug, Clone, Copy)]
struct Landing {
    id: u32,
    /// Index among the present contacts.
    contact: u8,
    spot: SurfacePoint,
    total: u32,
    /// Sums of its taxels on the link of its place.
    sums: PressSums,
}

/// Sums of a link.
#[derive(Debug, Clone, Copy)]
struct LinkSums {
    press: PressSums,
    saturated: u16,
    /// Sum of place times total, of the contacts whose centroid lies on the link; and of their totals.
    places: [i64; 3],
    totals: u32,
}

impl LinkSums {
    const NONE: LinkSums = LinkSums { press: PressSums::NONE, saturated: 0, places: [0; 3], totals: 0 };
}

/// Number that stands for no link, and for no contact with a place.
const NONE: u8 = u8::MAX;

impl<const CONTACTS: usize> Pressing<CONTACTS> {
    /// Nothing presses.
    pub const fn new() -> Self {
        const { assert!(CONTACTS < NONE as usize && LINKS < NONE as usize, "numbers have 8 bits") };
        Pressing {
            landings: Vec::new(),
            sums: [LinkSums::NONE; LINKS],
            pressed: Vec::new(),
            blind: Vec::new(),
            saturated: [0; CONTACTS],
        }
    }

    /// Places the contacts of the last frame, and sums up what presses on each link: the pressure of their
    /// taxels before and after the filter, see `press.rs`. Built in place: call it once.
    #[inline(never)] // M0+: out of line
    pub fn sum<const RUNS: usize, const LABELS: usize, S: Slot>(
        &mut self,
        table: &Table<'_>,
        contact: &ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        images: [&[u16]; 2],
    ) {
        let mut placed = [(NONE, NONE); CONTACTS];
        for ((index, placed), slot) in (0..).zip(&mut placed).zip(contact.present()) {
            let touch = slot.contact();
            let Some(spot) = table.spot(layout, touch.panel, touch.x, touch.y) else { continue };
            *placed = (self.landings.len() as u8, spot.link);
            // There are as many places as contacts.
            let _ = self.landings.push(Landing {
                id: touch.id,
                contact: index,
                spot,
                total: touch.total,
                sums: PressSums::NONE,
            });
        }
        let links = links_of(table, layout);
        let [before, after] = images;
        let image = PressedImage { before, after, records: bytemuck::cast_slice(table.taxels()) };
        let mut batch = [(0, NO_RECORD); BATCH];
        contact.each_pressed(layout, |pressed| {
            let Some(link) = links.get(usize::from(pressed.panel)) else { return };
            let (landing, of) = placed.get(pressed.contact).copied().unwrap_or((NONE, NONE));
            let sums = if of == *link {
                self.landings.get_mut(usize::from(landing)).map(|landing| &mut landing.sums)
            } else {
                self.sums.get_mut(usize::from(*link)).map(|sums| &mut sums.press)
            };
            if let Some(sums) = sums {
                sums.press(&image, &pressed, &mut batch);
            }
        });
        for landing in &self.landings {
            if let Some(sums) = self.sums.get_mut(usize::from(landing.spot.link)) {
                sums.add(landing);
            }
        }
        for (link, _) in (0..).zip(&self.sums).filter(|(_, sums)| sums.press.pressed() > 0) {
            // There are as many places as links.
            let _ = self.pressed.push(link);
        }
    }

    /// Finds the taxels of the last frame that do not say what they feel: those that are saturated, and those
    /// that are faulty. Needs no sums.
    #[inline(never)] // M0+: out of line
    pub fn doubt<const RUNS: usize, const LABELS: usize, S: Slot>(
        &mut self,
        table: &Table<'_>,
        contact: &ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        [calibrated, filtered]: [&[u16]; 2],
        senses: &TaxelLimits<'_, impl Fn(usize) -> u16>,
    ) {
        // A contact may be saturated if its peak is within the upper half of what that taxel can measure.
        let mut levels = [u16::MAX; CONTACTS];
        for (level, slot) in levels.iter_mut().zip(contact.present()) {
            let touch = slot.contact();
            let half = layout.taxel(touch.peak_at).map_or(u16::MAX, |taxel| (senses.ceiling)(taxel) / 2);
            if touch.peak >= half {
                *level = half;
            }
        }
        if levels.iter().any(|level| *level != u16::MAX) {
            contact.each_pressed(layout, |pressed| {
                let level = levels.get(pressed.contact).copied().unwrap_or(u16::MAX);
                for (first, run) in pressed.each().filter(|(_, run)| run.peak >= level) {
                    let saturated = saturated(first, run, level, calibrated, &senses.ceiling);
                    self.saturate(saturated, pressed.contact, table.taxels().get(first));
                }
            });
        }
        for faulty in senses.faulty {
            let taxel = usize::from(faulty.taxel);
            let Some(place) = layout.place(taxel) else { continue };
            let most = most_at(filtered, layout, place);
            let placed = table.taxels().get(taxel).filter(|record| most > 0 && record.is_placed());
            let Some(link) = placed.map(|record| record.link) else { continue };
            let counted = contact.contact_at(layout, place);
            let Some(index) = counted.or_else(|| beside(contact, layout, place)) else { continue };
            let counted = counted.and_then(|_| filtered.get(taxel)).copied().unwrap_or(0);
            let most = most.max(counted);
            // There are as many places as faulty taxels.
            let _ = self.blind.push(BlindTaxel {
                taxel: faulty.taxel,
                contact: index as u8,
                link,
                counted,
                most,
            });
        }
    }

    /// Counts saturated taxels of a contact, one of which is `taxel`.
    fn saturate(&mut self, count: u16, contact: usize, taxel: Option<&TaxelRecord>) {
        if let Some(saturated) = self.saturated.get_mut(contact) {
            *saturated = saturated.saturating_add(count);
        }
        let link = taxel.map_or(NONE.into(), |taxel| usize::from(taxel.link));
        if let Some(sums) = self.sums.get_mut(link) {
            sums.saturated = sums.saturated.saturating_add(count);
        }
    }

    /// True if some taxel does not say what it feels.
    pub fn is_in_doubt(&self) -> bool {
        !self.blind.is_empty() || self.sums.iter().any(|sums| sums.saturated > 0)
    }

    /// Returns the uncertainty of contacts, by id: of those that have some. Needs the sums.
    pub fn doubts_of_contacts<'a>(
        &'a self,
        table: &'a Table<'_>,
    ) -> impl Iterator<Item = (u32, Uncertainty)> + Clone + 'a {
        let of = |landing: &Landing| {
            let blind = self.blind.iter().filter(|blind| blind.contact == landing.contact);
            let far = |blind: &BlindTaxel| (*blind, reach(table, blind, landing.spot.at));
            let of = of_faulty(blind.map(far), landing.sums.pressed());
            let saturated = self.saturated.get(usize::from(landing.contact)).copied().unwrap_or(0);
            (landing.id, Uncertainty { saturated, ..of })
        };
        self.landings.iter().map(of).filter(|(_, of)| !of.is_none())
    }

    /// Returns the uncertainty of links, by number: of those that have some. Needs the sums.
    pub fn doubts_of_links<'a>(
        &'a self,
        table: &'a Table<'_>,
    ) -> impl Iterator<Item = (u8, Uncertainty)> + Clone + 'a {
        let of = |link: &u8| {
            let sums = self.sums.get(usize::from(*link)).unwrap_or(&LinkSums::NONE);
            let center = sums.center();
            let blind = self.blind.iter().filter(|blind| blind.link == *link);
            let far = |blind: &BlindTaxel| (*blind, reach(table, blind, center));
            let of = of_faulty(blind.map(far), sums.press.pressed());
            (*link, Uncertainty { saturated: sums.saturated, ..of })
        };
        self.pressed.iter().map(of).filter(|(_, of)| !of.is_none())
    }

    /// The contacts with a place, in the order of their onset; also in the frame of the poses, where there is
    /// one.
    pub fn contacts<'a>(
        &'a self,
        frames: &'a LinkFrames,
    ) -> impl ExactSizeIterator<Item = Landed> + Clone + 'a {
        self.landings.iter().map(|landing| landing.landed(frames))
    }

    /// The links that something presses on, in the order of the table.
    pub fn links<'a>(
        &'a self,
        table: &'a Table<'_>,
    ) -> impl ExactSizeIterator<Item = Wrench<&'a str>> + Clone + 'a {
        self.pressed.iter().map(|link| {
            let sums = self.sums.get(usize::from(*link)).unwrap_or(&LinkSums::NONE);
            sums.wrench(*link, table.link(*link).unwrap_or_default())
        })
    }
}

impl Landing {
    /// The contact as it is reported: also in the frame of the poses.
    #[inline(never)] // M0+: out of line
    fn landed(&self, frames: &LinkFrames) -> Landed {
        let (id, spot, force) = (self.id, self.spot, self.sums.force().map(counts));
        let base = frames.of(spot.link).map(|frame| InBase {
            at: frame.placed(spot.at),
            normal: frame.directed(spot.normal),
            force: frame.turned(force),
        });
        Landed { id, spot, force, base }
    }
}

impl<const CONTACTS: usize> Default for Pressing<CONTACTS> {
    fn default() -> Self {
        Pressing::new()
    }
}

impl LinkSums {
    /// Adds a contact on the link.
    fn add(&mut self, Landing { spot, total, sums, .. }: &Landing) {
        self.press.add_all(sums);
        // A total has at most 2^11 taxels of 2^16 counts.
        self.totals = self.totals.saturating_add(*total);
        for (sum, at) in self.places.iter_mut().zip(spot.at) {
            *sum = sum.wrapping_add(signed_wide(at, *total));
        }
    }

    #[inline(never)] // M0+: out of line
    fn wrench<'a>(&self, link: u8, name: &'a str) -> Wrench<&'a str> {
        let (force, moment, pressed) = (self.press.force(), self.press.moment(), self.press.pressed());
        Wrench {
            link,
            name,
            force: force.map(counts),
            // 2^-14 m to mm; below 2^27 counts at less than 2 m.
            moment: moment.map(|sum| against(sum.wrapping_mul(1000))),
            pressed,
            center: self.center(),
        }
    }

    /// Mean of the contacts' places, weighted by their totals.
    fn center(&self) -> Micrometres {
        let inverse = Inverse::of(self.totals);
        if self.totals > 0 { self.places.map(|sum| inverse.nearest(sum)) } else { [0; 3] }
    }
}

/// Number of saturated taxels of a run, whose first one is number `first`, among those of `level` counts and
/// more.
#[inline(never)] // M0+: out of line
fn saturated(first: usize, run: &Run, level: u16, calibrated: &[u16], ceiling: impl Fn(usize) -> u16) -> u16 {
    let (mut saturated, mut mask) = (0, run.rebased());
    let taxels = first..first + usize::from(run.width());
    for (taxel, value) in taxels.clone().zip(calibrated.get(taxels).unwrap_or(&[])) {
        if *value >= level && mask & 1 == 1 && *value >= ceiling(taxel) {
            saturated += 1;
        }
        mask >>= 1;
    }
    saturated
}

/// Present contact of a neighbour of a taxel, the first in order: above, below, left, right.
fn beside<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
    contact: &ContactState<CONTACTS, RUNS, LABELS, S>,
    layout: &Layout,
    Place { panel, row, column }: Place,
) -> Option<usize> {
    [(-1, 0), (1, 0), (0, -1), (0, 1)].into_iter().find_map(|(down, right)| {
        let (row, column) = (row.checked_add_signed(down)?, column.checked_add_signed(right)?);
        contact.contact_at(layout, Place { panel, row, column })
    })
}

/// Distance of a faulty taxel from a point of its link, um.
fn reach(table: &Table<'_>, blind: &BlindTaxel, from: Micrometres) -> u32 {
    table.taxels().get(usize::from(blind.taxel)).map_or(0, |record| distance(record.at(), from))
}

/// Link of each panel: that of its first taxel with a place.
fn links_of(table: &Table<'_>, layout: &Layout) -> [u8; PANELS] {
    let mut links = [NONE; PANELS];
    for (link, area) in links.iter_mut().zip(layout.areas()) {
        let taxels = table.taxels().get(usize::from(area.base)..).unwrap_or(&[]);
        let count = usize::from(area.rows) * usize::from(area.columns);
        let placed = taxels.iter().take(count).find(|taxel| taxel.is_placed());
        *link = placed.map_or(NONE, |taxel| taxel.link);
    }
    links
}

/// A force in whole counts: at most 2^11 taxels with 2^16 counts each.
fn counts(sum: i64) -> i32 {
    against(sum) as i32
}

/// The opposite of a sum in units of 2^-14, rounded.
fn against(sum: i64) -> i64 {
    -(sum.wrapping_add(1 << 13) >> 14)
}
