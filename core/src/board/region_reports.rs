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
    pub fn name_regions(&mut self) {
        self.names = !self.is_empty();
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

    /// Number of the report to send: the names, else the states.
    pub fn due(&self) -> Option<u32> {
        self.due.map(|_| if self.names { Report::REGION_NAMES } else { Report::REGIONS })
    }

    /// Encodes the names of the regions of a table; returns false if they do not fit.
    pub fn put_names(&mut self, tx_frame: &mut TxFrame, table: &Table<'_>) -> bool {
        self.names = false;
        let names = (0..table.regions() as u8).map(|region| table.region(region).unwrap_or_default());
        tx_frame.put(Report::REGION_NAMES, &Each(names))
    }

    /// Encodes the states that are due; returns false if they do not fit.
    pub fn put_states(&mut self, tx_frame: &mut TxFrame) -> bool {
        let Some((frame, time)) = self.due.take() else { return true };
        tx_frame.put(Report::REGIONS, &(frame, time, self.states.all()))
    }
}
