//! Work that stops the scan: storing settings, resetting them, self-tests and tables.

use super::refusal::Refusal;
use super::saving::Next;
use super::settings::Saved;
use super::work::Work;
use super::{Board, Job};
use crate::boot::Aside;
use crate::format::Micros;
use crate::wire::Level;

/// Time to erase and rewrite a sector of the flash, ms: the maker's typical value; the maximum is ten times
/// as long.
const SECTOR_MS: u32 = 50;
/// Size of a sector, bytes.
const SECTOR: usize = 4096;
/// Further sectors: one for garment, scene and index, and one cleared for the next save.
const OTHERS: usize = 2;

/// Approximate time without scans while the settings of so many taxels are stored, ms.
fn deaf_ms(taxels: usize) -> u32 {
    // A gain and a baseline code, two bytes each.
    let sectors = (4 * taxels).div_ceil(SECTOR) + OTHERS;
    sectors as u32 * SECTOR_MS
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Returns the next work other than scanning, if it is due: one between two scans.
    pub(super) fn next_work(&mut self, now: Micros) -> Option<Job> {
        if self.saving.restarts(now) {
            return Some(Job::Restart);
        }
        if self.worked {
            return None;
        }
        let work = *self.works.front()?;
        if work == Work::Save && !self.may_save(now) {
            return None;
        }
        if work != Work::SelfTest && !self.senses.are_blind() {
            // Reactions to blindness come first: the flash takes longer than most can wait.
            self.senses.blind();
            self.look_after(now);
            if let Some((pin, level)) = self.outputs.next() {
                return Some(Job::Drive(pin, level));
            }
        }
        self.works.pop_front();
        self.saving.taken();
        self.saving.stop(now);
        self.worked = true;
        Some(match work {
            Work::Save => Job::Save,
            Work::Reset { undo } => Job::ResetSettings { undo },
            Work::SelfTest => Job::Examine,
            Work::StoreTable => Job::StoreTable,
            Work::KeepTable(kind) => Job::KeepTable(kind),
        })
    }

    /// True if the requested save is made now: nothing touches the garment, and the save was announced.
    fn may_save(&mut self, now: Micros) -> bool {
        let ms = deaf_ms(self.setup.layout.taxels());
        match self.saving.next(now, self.is_busy()) {
            Next::Announce => {
                let text = format_args!("scanning stops for about {ms} ms while the settings are stored");
                self.outbox.tell(Level::Info, text);
            }
            Next::Wait => {}
            Next::Refuse => {
                self.works.pop_front();
                self.saving.taken();
                let why = format_args!(
                    "something touches the garment, and for about {ms} ms nothing would be felt"
                );
                self.outbox.answer(Work::Save.request(), Some(why.into()));
            }
            Next::Save => return true,
        }
        false
    }

    /// True if something touches the garment, or a reaction to a touch lasts. Without a tare this is unknown,
    /// and `false`.
    pub(super) fn is_busy(&self) -> bool {
        if !self.tared {
            return false;
        }
        let rows = self.setup.scene.react.iter().zip(self.state.react().since());
        let reacts = rows.into_iter().any(|(row, since)| since.is_some() && !row.cause.is_of_board());
        reacts || self.state.is_touched()
    }

    /// Checks a request to store the settings: error during a tare, or if the flash allows no write.
    pub(super) fn save(&mut self, now: Micros) -> Result<(), Refusal> {
        if self.taring {
            return Err(Refusal::of("a tare is under way"));
        }
        self.saving.allowed(now).map_err(|minutes| {
            Refusal::from(format_args!(
                "the flash has been written often enough: it can be written again in {minutes} min"
            ))
        })
    }

    /// Takes the result of a save.
    pub(super) fn saved(&mut self, now: Micros, result: Result<Saved, &'static str>) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
        // A failed save may have written something, too.
        if result != Ok(Saved::Unchanged) {
            self.saving.charge(now);
        }
        if result.is_ok()
            && let Some(boot) = &mut self.boot
        {
            // The settings stored now are those in force.
            boot.aside = Aside::No;
        }
        self.outbox.answer(Work::Save.request(), result.err().map(Refusal::of));
    }

    /// Takes the result of resetting the stored settings, or of undoing that. On success the board restarts
    /// once the answer is sent, and then uses them or not.
    #[inline(never)]
    pub(super) fn settings_reset(&mut self, now: Micros, result: Result<Saved, &'static str>) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
        if result.is_ok() {
            self.saving.restart_soon(now);
        }
        let number = Work::Reset { undo: false }.request();
        self.outbox.answer(number, result.err().map(Refusal::of));
    }

    /// Limits the saves to those that were left before a reset.
    pub fn resume_saving(&mut self, left: u8) {
        self.saving.resume(left);
    }
}
