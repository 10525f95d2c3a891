//! Reports of what the regions of the surface feel.

use super::pace::Pace;
use super::tx_frame::TxFrame;
use crate::body::Placed;
use crate::format::Micros;
use crate::garment::Layout;
use crate::pipeline::CONTACTS;
use crate::surface::{RegionStates, SurfaceState, Table};
use crate::symbol::Words;
use crate::wire::{Each, Report};

/// The regions' states, sent when they change, and once a second.
pub(super) struct RegionReports {
    states: RegionStates<CONTACTS>,
    /// Frame of the states to send.
    due: Option<(u32, Micros)>,
    /// True if the regions' names are to be sent before their states.
    names: bool,
    /// Rate at which unchanged states are sent.
    beat: Pace,
}

impl RegionReports {
    pub const fn new() -> RegionReports {
        RegionReports { states: RegionStates::new(), due: None, names: false, beat: Pace::NEVER }
    }

    /// Another table is in force, or none: the states of the one before are replaced, as of frame `at`.
    pub fn reset(&mut self, table: Option<&Table<'_>>, at: (u32, Micros)) {
        self.due = (!self.is_empty()).then_some(at);
        self.states.reset(table);
        (self.names, self.beat) = (table.is_some(), Pace::new(1));
    }

    /// Names the regions again before their next states.
    pub fn introduce(&mut self) {
        self.names = true;
    }

    /// True if the table in force has no regions.
    pub fn is_empty(&self) -> bool {
        self.states.all().is_empty()
    }

    /// Follows the regions in a frame.
    pub fn feel(
        &mut self,
        (frame, time): (u32, Micros),
        (table, layout): (&Table<'_>, &Layout),
        present: &[Placed],
        words: impl Fn(u32) -> Words,
        poses: &SurfaceState,
    ) {
        let is_followed = !present.is_empty() || !self.states.is_at_rest();
        let has_changed = is_followed && self.states.follow(table, layout, present, words, poses, time);
        // States that wait are sent as they are then.
        if has_changed || self.beat.due(time) || self.due.is_some() {
            self.due = Some((frame, time));
        }
    }

    /// True if states are to be sent.
    pub fn is_due(&self) -> bool {
        self.due.is_some()
    }

    /// Encodes what is due: the names, else the states; none if nothing is. `false` if it does not fit.
    pub fn put(&mut self, tx_frame: &mut TxFrame, table: Option<&Table<'_>>) -> Option<bool> {
        let (frame, time) = self.due?;
        if let Some(table) = table.filter(|_| core::mem::take(&mut self.names)) {
            let names = (0..table.regions() as u8).map(|region| table.region(region).unwrap_or_default());
            return Some(tx_frame.put(Report::REGION_NAMES, &Each(names)));
        }
        self.due = None;
        Some(tx_frame.put(Report::REGIONS, &(frame, time, self.states.all())))
    }
}
