//! The garment's surface: what presses on the robot is told at a rate of its own.

use super::pace::Pace;
use super::refusal::Refusal;
use super::{Board, request};
use crate::format::{Micros, Name};
use crate::garment::Layout;
use crate::pipeline::CONTACTS;
use crate::surface::{LINKS, Pose, Pressing, SurfaceState, Table};
use crate::wire::PressingReport;
use heapless::Vec;

/// The surface in force.
pub(super) struct Surface {
    /// The stored table, and whether it fits the present garment.
    table: Option<&'static [u8]>,
    fits: bool,
    poses: SurfaceState,
    rate: Pace,
    /// Frame to tell of.
    due: Option<(u32, Micros)>,
    /// True if the last report told of something.
    told: bool,
}

impl Surface {
    pub const fn new() -> Surface {
        Surface {
            table: None,
            fits: false,
            poses: SurfaceState::new(),
            rate: Pace::NEVER,
            due: None,
            told: false,
        }
    }

    /// The table in force.
    pub fn table(&self) -> Option<Table<'static>> {
        if cfg!(feature = "surface") && self.fits { Table::view(self.table?) } else { None }
    }

    /// Puts a table in force if it fits the garment; forgets poses, which are of the links of another.
    pub fn wear(&mut self, table: Option<&'static [u8]>, layout: &Layout) {
        self.table = table;
        self.fits = table.is_some_and(|table| Table::check(table, layout).is_ok());
        self.poses = SurfaceState::new();
    }

    /// Another garment is worn.
    pub fn refit(&mut self, layout: &Layout) {
        if cfg!(feature = "surface") {
            self.wear(self.table, layout);
        }
    }

    /// Notes a frame to tell of: when something touches, and once when nothing does any more.
    pub fn note(&mut self, frame: u32, time: Micros, touched: bool) {
        if self.table().is_none() || !(touched || self.told) {
            return;
        }
        if self.rate.due(time) || self.due.is_some() {
            self.due = Some((frame, time));
        }
    }

    /// Report that is due. `press` makes it of a table.
    pub fn report(
        &mut self,
        press: impl FnOnce(&Table<'_>, &SurfaceState) -> Pressing<CONTACTS>,
    ) -> Option<PressingReport> {
        let (frame, time) = self.due.take()?;
        let table = self.table()?;
        let Pressing { contacts, links } = press(&table, &self.poses);
        self.told = !contacts.is_empty();
        Some(PressingReport { frame, time, posed: self.poses.told(), contacts, links })
    }

    /// True if a report is due.
    pub fn is_due(&self) -> bool {
        self.due.is_some()
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// The surface in force.
    pub fn surface(&self) -> Option<Table<'static>> {
        self.surface.table()
    }

    /// Takes poses of links.
    #[inline(never)]
    pub(super) fn take_poses(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let table = self.surface.table().ok_or_else(|| Refusal::of(NO_SURFACE))?;
        let poses = request::read::<Vec<(Name, Pose), LINKS>>("poses", bytes)?;
        self.surface.poses.accept(&poses, &table, now).map_err(Refusal::of)
    }

    /// Sets the rate of reports of what presses on the robot.
    #[inline(never)]
    pub(super) fn tell_pressing(&mut self, hz: u16) -> Result<(), Refusal> {
        if hz > 0 && self.surface.table().is_none() {
            return Err(Refusal::of(NO_SURFACE));
        }
        self.surface.rate = Pace::new(hz);
        self.surface.due = None;
        Ok(())
    }
}

/// Refusal without a table.
const NO_SURFACE: &str = "no surface is in force";
