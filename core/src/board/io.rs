//! Inputs of the board, and outputs to its loop.

use super::settings::Saved;
use crate::acquire::{Plan, Scan, ScanError};
use crate::reflex::Early;
use crate::selftest::Findings;
use crate::wire::{StartOfFrame, TableKind};

/// Input of the board: an event, or the passing of time.
#[derive(Debug)]
pub enum Input<'a> {
    /// Bytes from the host, split anywhere.
    Received(&'a [u8]),
    /// A scan finished, or failed.
    Scanned(Result<Scan<'a>, ScanError>),
    /// Result of [`Job::Save`].
    Saved(Result<Saved, &'static str>),
    /// Result of [`Job::ResetSettings`].
    SettingsReset(Result<Saved, &'static str>),
    /// Result of [`Job::StoreTable`]: the whole table with its last piece.
    TableStored(Result<Option<&'static [u8]>, &'static str>),
    /// Result of [`Job::KeepTable`].
    TableKept(TableKind, Result<(), &'static str>),
    /// Result of a test of lines and inputs: at the start and after each [`Job::Examine`].
    Examined(Result<Findings, ScanError>),
    /// A select line was not at the level to which it was driven.
    Misled,
    /// A reaction began by reflex, within the frame being scanned or scanned last.
    Reflex(Early),
    /// Start of the frame of the USB that [`Board::asks_start_of_frame`](super::Board::asks_start_of_frame) has
    /// asked for.
    StartOfFrame(StartOfFrame),
    /// Asks for the next job.
    Tick,
}

/// Job that the board gives to its loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Job {
    /// Scan; answered by [`Input::Scanned`].
    Scan(Plan),
    /// Set the level of a pin.
    Drive(u8, bool),
    /// Store [`Board::settings`](super::Board::settings); answered by [`Input::Saved`].
    Save,
    /// Make the stored settings have no effect from the next start on, or restore them; answered by
    /// [`Input::SettingsReset`].
    ResetSettings {
        /// Restore them.
        undo: bool,
    },
    /// Store [`Board::piece_to_store`](super::Board::piece_to_store); answered by [`Input::TableStored`].
    StoreTable,
    /// Make the table whose pieces were stored last the one of its kind in force, or none if its length is 0;
    /// answered by [`Input::TableKept`].
    KeepTable(TableKind),
    /// Restart, as after power-on.
    Restart,
    /// Stop a free-running scan, and examine lines and inputs: the circuit has changed, the host asks for it,
    /// or there is evidence against one of them. Answered by [`Input::Examined`].
    Examine,
}
