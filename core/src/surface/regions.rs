//! Symbols on the surface: what each region of the body feels, in words.
//!
//! Every region always has a state: free, touched just now, held, moved over along an axis of the body, or
//! released just now; with the words of the contact that presses most. Axes are those of the frame of the
//! poses (x forward, y to the left, z up) or, without a pose of the link, of the link.

use super::frames::{LinkFrames, SurfaceState};
use super::place::SurfacePoint;
use super::table::Table;
use super::{Micrometres, REGIONS};
use crate::body::Placed;
use crate::format::Micros;
use crate::garment::Layout;
use crate::shape::Class;
use crate::symbol::{Extent, Strength, Words};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Phase of a region. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RegionPhase {
    /// Nothing touches it.
    #[default]
    Free,
    /// Something has touched it for less than [`ONSET_MS`].
    Onset,
    /// Something rests on it.
    Held,
    /// Something slides over it.
    Moving,
    /// Nothing has touched it for less than [`RELEASED_MS`].
    Released,
}

/// Direction along an axis of the body. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyDirection {
    /// No motion.
    #[default]
    None,
    /// Along +x.
    Forward,
    /// Along -x.
    Back,
    /// Along +y.
    Left,
    /// Along -y.
    Right,
    /// Along +z.
    Up,
    /// Along -z.
    Down,
}

/// Touch state of a region.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionSymbol {
    /// Phase of the touch.
    pub phase: RegionPhase,
    /// Direction of the contact that presses most.
    pub way: BodyDirection,
    /// Number of contacts whose place is in it.
    pub contacts: u8,
    /// Level: strength of the contact that presses most, or that pressed last.
    pub strength: Strength,
    /// Extent of the touch.
    pub extent: Extent,
    /// Shape of the touch.
    pub class: Class,
    /// Time since which the region is in its phase.
    pub since: Micros,
}

/// Time for which a touch is an onset, ms.
pub const ONSET_MS: u64 = 150;
/// Time for which a release is reported, ms.
pub const RELEASED_MS: u64 = 500;
/// Way that a contact has gone before its direction is known, um.
const STEP_UM: i32 = 5_000;

/// A contact on the surface, and where it began its present step.
#[derive(Debug, Clone, Copy)]
struct Walker {
    id: u32,
    link: u8,
    from: Micrometres,
    way: BodyDirection,
}

/// State of the stage, for at most CONTACTS contacts.
#[derive(Debug)]
pub struct RegionStates<const CONTACTS: usize> {
    regions: Vec<RegionSymbol, REGIONS>,
    walkers: Vec<Walker, CONTACTS>,
}

impl<const CONTACTS: usize> RegionStates<CONTACTS> {
    /// No regions.
    pub const fn new() -> Self {
        RegionStates { regions: Vec::new(), walkers: Vec::new() }
    }

    /// All regions of a table become free.
    pub fn reset(&mut self, table: Option<&Table<'_>>) {
        self.regions.clear();
        self.walkers.clear();
        // A checked table has no more.
        let _ = self.regions.resize(table.map_or(0, Table::regions), RegionSymbol::default());
    }

    /// The regions, in the order of the table.
    pub fn all(&self) -> &[RegionSymbol] {
        &self.regions
    }

    /// True if the stage has nothing to do while nothing touches.
    pub fn is_at_rest(&self) -> bool {
        self.regions.iter().all(|region| region.phase == RegionPhase::Free)
    }

    /// Follows the present contacts, each with its words. True if a region's state has changed.
    #[inline(never)] // M0+: out of line
    pub fn follow(
        &mut self,
        table: &Table<'_>,
        layout: &Layout,
        present: &[Placed],
        words: impl Fn(u32) -> Words,
        poses: &SurfaceState,
        now: Micros,
    ) -> bool {
        self.walkers.retain(|walker| present.iter().any(|placed| placed.contact.id == walker.id));
        let mut felt = [RegionInput::default(); REGIONS];
        // Only a contact that has moved needs it.
        let mut frames = None;
        for Placed { contact, .. } in present {
            let Some((spot, region)) = table.spot_in(layout, contact.panel, contact.x, contact.y) else {
                continue;
            };
            let words = words(contact.id);
            let way =
                self.walk(contact.id, &spot, words.moving, || *frames.get_or_insert_with(|| poses.at(now)));
            let Some(felt) = felt.get_mut(usize::from(region)) else { continue };
            felt.contacts = felt.contacts.saturating_add(1);
            if contact.total > felt.total || felt.contacts == 1 {
                (felt.total, felt.words, felt.way) = (contact.total, words, way);
            }
        }
        let mut has_changed = false;
        for (region, felt) in self.regions.iter_mut().zip(&felt) {
            has_changed |= region.follow(felt, now);
        }
        has_changed
    }

    /// Direction of a contact.
    fn walk(
        &mut self,
        id: u32,
        spot: &SurfacePoint,
        moving: bool,
        frames: impl FnOnce() -> LinkFrames,
    ) -> BodyDirection {
        let at = match self.walkers.iter().position(|walker| walker.id == id) {
            Some(at) => at,
            None => {
                // There are as many places as contacts.
                let new = Walker { id, link: spot.link, from: spot.at, way: BodyDirection::None };
                let _ = self.walkers.push(new);
                self.walkers.len() - 1
            }
        };
        let Some(walker) = self.walkers.get_mut(at) else { return BodyDirection::None };
        if !moving || walker.link != spot.link {
            *walker = Walker { id, link: spot.link, from: spot.at, way: BodyDirection::None };
            return BodyDirection::None;
        }
        let [x, y, z] = walker.from;
        let [dx, dy, dz] = [spot.at[0] - x, spot.at[1] - y, spot.at[2] - z];
        if dx.abs().max(dy.abs()).max(dz.abs()) >= STEP_UM {
            walker.way = main_axis(frames().turned(spot.link, [dx, dy, dz]));
            walker.from = spot.at;
        }
        walker.way
    }
}

impl<const CONTACTS: usize> Default for RegionStates<CONTACTS> {
    fn default() -> Self {
        RegionStates::new()
    }
}

/// Contacts on a region in a frame.
#[derive(Debug, Default, Clone, Copy)]
struct RegionInput {
    contacts: u8,
    total: u32,
    words: Words,
    way: BodyDirection,
}

impl RegionSymbol {
    /// Follows a frame; true if something has changed.
    fn follow(&mut self, felt: &RegionInput, now: Micros) -> bool {
        let before = *self;
        let lasts_us = now.since(self.since);
        let is_over = |ms: u64| lasts_us >= ms * 1000;
        let was_touched = matches!(self.phase, RegionPhase::Onset | RegionPhase::Held | RegionPhase::Moving);
        self.contacts = felt.contacts;
        let phase = if felt.contacts == 0 {
            self.way = BodyDirection::None;
            match self.phase {
                RegionPhase::Free => RegionPhase::Free,
                RegionPhase::Released if is_over(RELEASED_MS) => RegionPhase::Free,
                _ => RegionPhase::Released,
            }
        } else {
            (self.strength, self.extent, self.class) =
                (felt.words.strength, felt.words.extent, felt.words.class);
            self.way = felt.way;
            if !was_touched || self.phase == RegionPhase::Onset && !is_over(ONSET_MS) {
                RegionPhase::Onset
            } else if felt.way == BodyDirection::None {
                RegionPhase::Held
            } else {
                RegionPhase::Moving
            }
        };
        if phase != self.phase {
            (self.phase, self.since) = (phase, now);
        }
        *self != before
    }
}

/// The axis along which a vector is longest.
fn main_axis([x, y, z]: [i32; 3]) -> BodyDirection {
    let [along, across, upright] = [x, y, z].map(i32::unsigned_abs);
    if along >= across && along >= upright {
        if x >= 0 { BodyDirection::Forward } else { BodyDirection::Back }
    } else if across >= upright {
        if y >= 0 { BodyDirection::Left } else { BodyDirection::Right }
    } else if z >= 0 {
        BodyDirection::Up
    } else {
        BodyDirection::Down
    }
}
