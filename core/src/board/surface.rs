//! The garment's surface: what presses on the robot is reported at a rate of its own.

use super::outbox::{Reports, only};
use super::pace::Pace;
use super::reading;
use super::refusal::Refusal;
use super::region_reports::RegionReports;
use super::tx_frame::TxFrame;
use crate::body::Placed;
use crate::format::Micros;
use crate::garment::Layout;
use crate::pipeline::CONTACTS;
use crate::surface::{Pressing, SurfaceState, Table};
use crate::symbol::Words;
use crate::wire::{Each, Poses, Report};

/// The surface in force.
pub(super) struct Surface {
    /// The stored table, and whether it fits the present garment.
    table: Option<&'static [u8]>,
    fits: bool,
    poses: SurfaceState,
    /// Reports of the regions: without the feature there is no room for them.
    regions: [RegionReports; USED],
    hz: u16,
    rate: Pace,
    /// Frame to report.
    due: Option<(u32, Micros)>,
    /// True if the last report reported something.
    reported: bool,
    /// True if the next frame is not reported, because there was much to report of this one.
    pauses: bool,
}

impl Surface {
    pub const fn new() -> Surface {
        Surface {
            table: None,
            fits: false,
            poses: SurfaceState::new(),
            regions: [const { RegionReports::new() }; USED],
            hz: 0,
            rate: Pace::NEVER,
            due: None,
            reported: false,
            pauses: false,
        }
    }

    /// The table in force.
    pub fn table(&self) -> Option<Table<'static>> {
        if self.is_in_force() { Table::view(self.table?) } else { None }
    }

    /// True if a table is in force; cheaper than to view it.
    fn is_in_force(&self) -> bool {
        cfg!(feature = "surface") && self.fits
    }

    /// Puts a table in force if it fits the garment; forgets poses, which are of the links of another. What
    /// was reported by the table before is reported anew, as of frame `at`.
    pub fn install(&mut self, table: Option<&'static [u8]>, layout: &Layout, at: (u32, Micros)) {
        self.table = table;
        self.fits = table.is_some_and(|table| Table::check(table, layout).is_ok());
        self.poses = SurfaceState::new();
        let table = self.table();
        self.regions.iter_mut().for_each(|regions| regions.reset(table.as_ref(), at));
        self.due = self.reported.then_some(at);
    }

    /// Names the regions again before their next states.
    pub fn name_regions(&mut self) {
        self.regions.iter_mut().for_each(RegionReports::name_regions);
    }

    /// Sets the rate of reports of what presses on the robot. What was reported at another rate before is
    /// reported anew, as of frame `at`; without a rate, that nothing presses.
    pub fn pace(&mut self, hz: u16, at: (u32, Micros)) {
        if core::mem::replace(&mut self.hz, hz) != hz {
            self.rate = Pace::new(hz);
            self.due = self.reported.then_some(at);
        }
    }

    /// Takes poses of links, encoded, at `now` unless they say when they are from.
    #[inline(never)]
    pub fn take_poses(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let table = self.table().ok_or_else(|| Refusal::of("no surface is in force"))?;
        let Poses { at, links } = reading::value("poses", bytes)?;
        self.poses.accept(&links, &table, at.unwrap_or(now)).map_err(Refusal::of)
    }

    /// Follows the regions in a frame.
    pub fn update_regions(
        &mut self,
        frame: (u32, Micros),
        layout: &Layout,
        present: &[Placed],
        words: impl Fn(u32) -> Words,
    ) {
        // Most tables have none, and to view one takes a division.
        if self.regions.iter().all(RegionReports::is_empty) {
            return;
        }
        if let (Some(table), Some(regions)) = (self.table(), self.regions.first_mut()) {
            regions.feel(frame, (&table, layout), present, words, &self.poses);
        }
    }

    /// Another garment is in use.
    pub fn revalidate(&mut self, layout: &Layout, at: (u32, Micros)) {
        if cfg!(feature = "surface") {
            self.install(self.table, layout, at);
        }
    }

    /// Notes a frame to report: when something touches, and once when nothing does any more. `present` are
    /// its contacts.
    pub fn note(&mut self, frame: u32, time: Micros, present: &[Placed], touched: bool) {
        if !self.is_in_force() || !(touched || self.reported) || core::mem::take(&mut self.pauses) {
            return;
        }
        if self.rate.due(time) || self.due.is_some() {
            self.due = Some((frame, time));
            self.pauses = are_many(present);
        }
    }

    /// Reports that are due.
    pub fn due(&self) -> Reports {
        if !cfg!(feature = "surface") {
            return 0;
        }
        let pressing = self.due.map(|_| Report::PRESSING);
        let regions = self.regions.iter().filter_map(RegionReports::due);
        pressing.into_iter().chain(regions).fold(0, |all, number| all | only(number))
    }

    /// Encodes a report that is due. `doubt` finds what is unknown of what presses, `sum` sums it up, both by a
    /// table. Returns `false` if it does not fit. Own frame: it needs much stack.
    #[inline(never)]
    pub fn put(
        &mut self,
        number: u32,
        tx_frame: &mut TxFrame,
        doubt: impl FnOnce(&mut Pressing<CONTACTS>, &Table<'_>),
        sum: impl FnOnce(&mut Pressing<CONTACTS>, &Table<'_>),
    ) -> bool {
        let table = self.table();
        let regions = self.regions.first_mut();
        match (number, regions, table) {
            (Report::REGION_NAMES, Some(regions), Some(table)) => regions.put_names(tx_frame, &table),
            (Report::REGIONS, Some(regions), _) => regions.put_states(tx_frame),
            _ => self.put_pressing(tx_frame, doubt, sum),
        }
    }

    /// Encodes what presses on the robot.
    fn put_pressing(
        &mut self,
        tx_frame: &mut TxFrame,
        doubt: impl FnOnce(&mut Pressing<CONTACTS>, &Table<'_>),
        sum: impl FnOnce(&mut Pressing<CONTACTS>, &Table<'_>),
    ) -> bool {
        let Some((frame, time)) = self.due.take() else { return true };
        let Some(table) = self.table().filter(|_| !self.rate.is_never()) else {
            self.reported = false;
            let nothing: &[()] = &[];
            return tx_frame.put(Report::PRESSING, &(frame, time, None::<Micros>, nothing, nothing));
        };
        let mut pressing = Pressing::new();
        doubt(&mut pressing, &table);
        sum(&mut pressing, &table);
        let frames = self.poses.at(time);
        let (contacts, links) = (pressing.contacts(&frames), pressing.links(&table));
        self.reported = contacts.len() > 0;
        let report = (frame, time, self.poses.updated(), Each(contacts), Each(links));
        if !pressing.is_in_doubt() && frames.errors().next().is_none() {
            // A reader takes what is missing as empty.
            return tx_frame.put(Report::PRESSING, &report);
        }
        let bounds = (Each(pressing.doubts_of_contacts(&table)), Each(pressing.doubts_of_links(&table)));
        tx_frame.put(Report::PRESSING, &(report, bounds, Each(frames.errors())))
    }
}

/// Contacts, and taxels under them, that are reported in each frame if this is asked for. More are reported in
/// every second one: a frame has no time for them beside all else.
const MOST_CONTACTS: usize = 16;
const MOST_TAXELS: u32 = 512;

/// True if there are more than can be reported in each frame.
fn are_many(present: &[Placed]) -> bool {
    let taxels = || present.iter().map(|placed| u32::from(placed.contact.area)).sum::<u32>();
    present.len() > MOST_CONTACTS || taxels() > MOST_TAXELS
}

/// 1 if this build has a surface, else 0.
const USED: usize = if cfg!(feature = "surface") { 1 } else { 0 };

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::contact::Contact;

    /// Frames that are reported if each of them has so many contacts of nine taxels.
    fn reported(contacts: u32) -> std::vec::Vec<u32> {
        let present: std::vec::Vec<Placed> =
            (0..contacts).map(|id| Contact::of_nine(id, 0, 900).into()).collect();
        let mut surface = Surface { fits: true, rate: Pace::new(u16::MAX), ..Surface::new() };
        let mut reported = |frame: u32| {
            surface.note(frame, Micros(u64::from(frame) * 5_120), &present, true);
            surface.due.take().is_some_and(|(noted, _)| noted == frame)
        };
        (0..8).filter(|frame| reported(*frame)).collect()
    }

    #[test]
    fn many_contacts_are_reported_in_every_second_frame() {
        assert_eq!(reported(16), [0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(reported(17), [0, 2, 4, 6]);
    }

    #[test]
    fn many_taxels_are_many() {
        let large = |area| [Placed::from(Contact { area, ..Contact::of_nine(0, 0, 900) })];
        assert!(!are_many(&large(512)) && are_many(&large(513)));
    }
}
