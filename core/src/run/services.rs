//! Parts of a board that the loop needs besides its scan: a link to the host, and services.

use crate::acquire::Clock;
use crate::board::{PieceToStore, Saved, Settings, TableKind};
use crate::format::Micros;
use crate::pipeline::Probe;
use crate::wire::{Checksum, StartOfFrame};

/// Error of a platform without a place for tables.
const NO_ROOM: &str = "this board has no room for such a table";

/// A byte link that never waits. Interrupts or threads move the bytes between the rings behind it and the
/// wire.
pub trait Link {
    /// Copies received bytes into `buffer`; returns their number.
    fn try_read(&mut self, buffer: &mut [u8]) -> usize;
    /// Queues bytes to send; returns how many were accepted.
    fn try_write(&mut self, bytes: &[u8]) -> usize;
    /// Returns when the first frame of the USB after the last `true` began; none before it has, once it was
    /// returned, and on other links.
    fn start_of_frame(&mut self, _next: bool) -> Option<StartOfFrame> {
        None
    }
}

/// Services of a board other than its pins, its converter and its link.
#[allow(async_fn_in_trait)] // one board, one executor: the future need not be Send
pub trait Platform: Clock + Probe + Checksum {
    /// Called once per round of the loop: feeds the watchdog. `false` ends the loop, which only a host does.
    fn alive(&mut self) -> bool;
    /// Stores the settings; the error says why they were not stored.
    fn save(&mut self, settings: &Settings<'_>) -> Result<Saved, &'static str>;
    /// Makes the stored settings have no effect from the next start on, or restores them (`undo`). The error
    /// says why this failed.
    fn reset_settings(&mut self, undo: bool) -> Result<Saved, &'static str>;
    /// Stores a piece of a table beside the one of its kind in force. Returns the whole table with its
    /// last piece; the error says why it was not stored.
    fn store_table(&mut self, _: &PieceToStore<'_>) -> Result<Option<&'static [u8]>, &'static str> {
        Err(NO_ROOM)
    }
    /// Makes the table of this length whose pieces were stored last the one of its kind that a start finds,
    /// or none if the length is 0.
    fn keep_table(&mut self, _: TableKind, _: u32) -> Result<(), &'static str> {
        Err(NO_ROOM)
    }
    /// Restarts the board. A host may end its loop instead.
    fn restart(&mut self);
    /// Waits until `until`, 1 ms at most, because bytes may arrive or leave meanwhile.
    async fn idle(&mut self, until: Micros);
}
