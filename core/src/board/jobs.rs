//! Work that stops the scan: storing settings, resetting them, self-tests and tables.

use super::effects::Effects;
use super::refusal::Refusal;
use super::saving::{Next, Saving};
use super::settings::Saved;
use crate::format::Micros;
use crate::wire::{Level, Request, TableKind};
use heapless::Deque;

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

/// Work other than scanning, done between two scans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Work {
    SelfTest,
    Save,
    Reset { undo: bool },
    StoreTable,
    KeepTable(TableKind),
}

impl Work {
    /// Number of the request for it, which is answered when it is done.
    pub const fn request(self) -> u8 {
        match self {
            Work::SelfTest => Request::SelfTest.number(),
            Work::Save => Request::Save.number(),
            Work::Reset { .. } => Request::ResetSettings { undo: false }.number(),
            Work::StoreTable | Work::KeepTable(_) => Request::SetTable(&[]).number(),
        }
    }
}

/// The work that waits or is under way.
pub(super) struct Jobs {
    works: Deque<Work, 4>,
    /// True from the start of a [`Work`] to the end of the next scan.
    is_worked: bool,
    saving: Saving,
}

impl Jobs {
    pub const fn new() -> Jobs {
        Jobs { works: Deque::new(), is_worked: false, saving: Saving::new() }
    }

    /// Limits the saves to those that were left before a reset.
    pub fn resume(&mut self, left: u8) {
        self.saving.resume(left);
    }

    /// Number of saves left after the next one.
    pub fn saves_left(&self) -> u8 {
        self.saving.left_after()
    }

    /// Adds work.
    pub fn add(&mut self, work: Work) -> Result<(), Refusal> {
        self.works.push_back(work).map_err(|_| Refusal::of("too much is waiting to be done"))
    }

    /// True if a piece of a table is not stored yet, or a table not kept.
    pub fn has_table(&self) -> bool {
        self.works.iter().any(|work| matches!(work, Work::StoreTable | Work::KeepTable(_)))
    }

    /// Error if the flash must not be written: during a tare, or too soon.
    pub fn may_write(&mut self, now: Micros, is_taring: bool) -> Result<(), Refusal> {
        if is_taring {
            return Err(Refusal::of("a tare is under way"));
        }
        self.saving.allowed(now).map_err(|minutes| {
            Refusal::from(format_args!(
                "the flash has been written often enough: it can be written again in {minutes} min"
            ))
        })
    }

    /// Records a write of the flash.
    pub fn charge(&mut self, now: Micros) {
        self.saving.charge(now);
    }

    /// True if the board is to restart now.
    pub fn restarts(&self, now: Micros) -> bool {
        self.saving.restarts(now)
    }

    /// A scan has ended.
    pub fn scanned(&mut self) {
        self.is_worked = false;
    }

    /// Work to be begun now, one between two scans. A save waits for touches to end: `is_busy`; the garment has
    /// so many taxels.
    pub fn due<const TAXELS: usize>(
        &mut self,
        now: Micros,
        (is_busy, taxels): (impl FnOnce() -> bool, usize),
        effects: &mut Effects<'_, TAXELS>,
    ) -> Option<Work> {
        let work = *self.works.front().filter(|_| !self.is_worked)?;
        if work != Work::Save {
            return Some(work);
        }
        let ms = deaf_ms(taxels);
        match self.saving.next(now, is_busy()) {
            Next::Announce => {
                let text = format_args!("scanning stops for about {ms} ms while the settings are stored");
                effects.outbox.queue_log(Level::Info, text);
            }
            Next::Wait => {}
            Next::Refuse => {
                self.works.pop_front();
                self.saving.taken();
                let why = format_args!(
                    "something touches the garment, and for about {ms} ms nothing would be felt"
                );
                effects.answer(Work::Save.request(), Some(why.into()));
            }
            Next::Save => return Some(work),
        }
        None
    }

    /// Begins the work that is due.
    pub fn begin(&mut self, now: Micros) {
        self.works.pop_front();
        self.saving.taken();
        self.saving.stop(now);
        self.is_worked = true;
    }

    /// Ends the work that was begun; returns the time without scans, us, none if none was.
    pub fn ended(&mut self, now: Micros) -> Option<u64> {
        self.saving.ended(now)
    }

    /// Takes the result of a save.
    pub fn saved<const TAXELS: usize>(
        &mut self,
        now: Micros,
        result: Result<Saved, &'static str>,
        effects: &mut Effects<'_, TAXELS>,
    ) {
        // A failed save may have written something, too.
        if result != Ok(Saved::Unchanged) {
            self.saving.charge(now);
        }
        effects.answer(Work::Save.request(), result.err().map(Refusal::of));
    }

    /// Takes the result of resetting the stored settings, or of undoing that. On success the board restarts
    /// once the answer is sent, and then uses them or not.
    pub fn settings_reset<const TAXELS: usize>(
        &mut self,
        now: Micros,
        result: Result<Saved, &'static str>,
        effects: &mut Effects<'_, TAXELS>,
    ) {
        if result.is_ok() {
            self.saving.restart_soon(now);
        }
        effects.answer(Work::Reset { undo: false }.request(), result.err().map(Refusal::of));
    }
}
