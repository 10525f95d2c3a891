//! The garment's folds: their table follows garment and scene; what is expected of them is reported.

use super::outbox::{Reports, only};
use super::pace::Pace;
use super::perception::Perception;
use super::setup::Setup;
use super::tx_frame::TxFrame;
use crate::fold::{Doubt, Expected, FoldState, FoldTable};
use crate::format::Micros;
use crate::pipeline::CONTACTS;
use crate::wire::{FoldsReport, Report};
use heapless::Vec;

/// Rate of reports while a table is in force, per second.
const RATE_HZ: u16 = 10;

/// The stored table of folds, and the reports of it.
pub(super) struct Folds {
    table: Option<&'static [u8]>,
    /// True if it fits the present garment.
    fits: bool,
    rate: Pace,
    /// Frame to report.
    due: Option<(u32, Micros)>,
}

impl Folds {
    pub const fn new() -> Folds {
        Folds { table: None, fits: false, rate: Pace::NEVER, due: None }
    }

    /// Puts a table in force.
    pub fn install(&mut self, table: Option<&'static [u8]>) {
        self.table = table;
    }

    /// Checks the table in force for another garment or scene, and hands it to the stage if it fits; only then
    /// there are reports.
    pub fn revalidate<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    ) {
        let Setup { layout, scene, .. } = &perception.setup;
        let table = self.table.and_then(|table| FoldTable::check(table, layout).ok());
        (self.fits, self.rate) = (table.is_some(), Pace::new(RATE_HZ));
        perception.state.condition.use_folds(table, &scene.joints);
    }

    /// Notes a frame to report.
    pub fn note(&mut self, frame: u32, time: Micros) {
        if self.fits && (self.rate.due(time) || self.due.is_some()) {
            self.due = Some((frame, time));
        }
    }

    /// Reports that are due.
    pub fn due(&self) -> Reports {
        self.due.map_or(0, |_| only(Report::FOLDS))
    }

    /// Encodes the report that is due, with the doubts of the present contacts; returns false if it does not
    /// fit. Own frame: it needs much stack.
    #[inline(never)]
    pub fn put(
        &mut self,
        tx_frame: &mut TxFrame,
        folds: &FoldState,
        contacts: impl FnOnce() -> Vec<Doubt, CONTACTS>,
    ) -> bool {
        let Some((frame, time)) = self.due.take() else { return true };
        let Expected { taxels, total, doubt } = folds.expected();
        let report = FoldsReport {
            frame,
            time,
            posed: folds.posture.updated(),
            followed: folds.is_followed(),
            taxels,
            total,
            doubt,
            contacts: contacts(),
        };
        tx_frame.put(Report::FOLDS, &report)
    }
}
