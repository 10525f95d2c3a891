//! The garment's folds: their table follows garment and scene; what is expected of them is told.

use super::pace::Pace;
use crate::fold::{Doubt, Expected, FoldState, FoldTable};
use crate::format::Micros;
use crate::garment::Layout;
use crate::pipeline::CONTACTS;
use crate::wire::FoldsReport;
use heapless::Vec;

/// Rate of reports while a table is in force, per second.
const RATE_HZ: u16 = 10;

/// The stored table of folds, and the reports of it.
pub(super) struct Folds {
    table: Option<&'static [u8]>,
    /// True if it fits the present garment.
    fits: bool,
    rate: Pace,
    /// Frame to tell of.
    due: Option<(u32, Micros)>,
}

impl Folds {
    pub const fn new() -> Folds {
        Folds { table: None, fits: false, rate: Pace::NEVER, due: None }
    }

    /// Puts a table in force.
    pub fn wear(&mut self, table: Option<&'static [u8]>) {
        self.table = table;
    }

    /// Returns the table in force, if it fits a garment; only then there are reports.
    pub fn fit(&mut self, layout: &Layout) -> Option<FoldTable<'static>> {
        let table = self.table.and_then(|table| FoldTable::check(table, layout).ok());
        (self.fits, self.rate) = (table.is_some(), Pace::new(RATE_HZ));
        table
    }

    /// Notes a frame to tell of.
    pub fn note(&mut self, frame: u32, time: Micros) {
        if self.fits && (self.rate.due(time) || self.due.is_some()) {
            self.due = Some((frame, time));
        }
    }

    /// True if a report is due.
    pub fn is_due(&self) -> bool {
        self.due.is_some()
    }

    /// Report that is due, with the doubts of the present contacts.
    pub fn report(
        &mut self,
        folds: &FoldState,
        contacts: impl FnOnce() -> Vec<Doubt, CONTACTS>,
    ) -> Option<FoldsReport> {
        let (frame, time) = self.due.take()?;
        let Expected { taxels, total, doubt } = folds.expected();
        Some(FoldsReport {
            frame,
            time,
            posed: folds.posture.told(),
            followed: folds.is_followed(),
            taxels,
            total,
            doubt,
            contacts: contacts(),
        })
    }
}
