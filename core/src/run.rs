//! The board's loop, shared by firmware, host and tests.

mod reader;

use crate::acquire::{Acquire, Clock};
use crate::board::{Board, Input, Job, PieceToStore, Saved, Settings, TableKind};
use crate::format::Micros;
use crate::pipeline::{Probe, Stage};
use crate::selftest::Examine;
use core::future::Future;
use core::pin::pin;
use core::task::{Context, Poll, Waker};
use reader::Reader;

/// True if this build has a use for tables.
const TABLES: bool = !TableKind::USED.is_empty();
/// Error of a platform without a place for tables.
const NO_ROOM: &str = "this board has no room for such a table";

/// A byte link that never waits. Interrupts or threads move the bytes between the rings behind it and the
/// wire.
pub trait Link {
    /// Copies received bytes into `buffer`; returns their number.
    fn try_read(&mut self, buffer: &mut [u8]) -> usize;
    /// Queues bytes to send; returns how many were accepted.
    fn try_write(&mut self, bytes: &[u8]) -> usize;
}

/// Services of a board other than its pins, its converter and its link.
#[allow(async_fn_in_trait)] // one board, one executor: the future need not be Send
pub trait Platform: Clock + Probe {
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
    /// Makes the table of this length whose pieces were stored last the one of its kind that a start finds, or
    /// none if the length is 0.
    fn keep_table(&mut self, _: TableKind, _: u32) -> Result<(), &'static str> {
        Err(NO_ROOM)
    }
    /// Restarts the board. A host may end its loop instead.
    fn restart(&mut self);
    /// Waits until `until`, 1 ms at most, because bytes may arrive or leave meanwhile.
    async fn idle(&mut self, until: Micros);
}

/// Runs a board for as long as its platform is alive. Starts with a self-test of lines and inputs.
pub async fn run<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    acquire: &mut (impl Acquire + Examine),
    link: &mut impl Link,
    platform: &mut impl Platform,
    board: &mut Board<TAXELS, RUNS, PARTS>,
) {
    examine(acquire, platform, board);
    let mut reader = Reader::new();
    while platform.alive() {
        reader.receive(link, platform, board);
        acquire.watch(board.reflexes(), board.reacting(), |taxel| board.inactive_code(taxel));
        let now = platform.now();
        let job = board.step(now, Input::Tick, platform);
        // A reaction's pin moves before its message is sent.
        if let Some(Job::Drive(pin, level)) = job {
            // The pin was checked with the scene. A line that fails is found by the next scan.
            let _ = acquire.drive(pin, level);
            continue;
        }
        send(link, platform, board);
        match job {
            Some(Job::Scan(plan)) => {
                if acquire.is_misled() {
                    let now = platform.now();
                    board.step(now, Input::Misled, platform);
                }
                platform.begin(Stage::Scan);
                let scan = acquire.scan(board.circuit(), &plan).await;
                platform.begin(Stage::Idle);
                let now = platform.now();
                board.step(now, Input::Scanned(scan), platform);
                while let Some(early) = acquire.reflex() {
                    let now = platform.now();
                    board.step(now, Input::Reflex(early), platform);
                }
                acquire.pose(board.circuit());
            }
            Some(Job::Save) => {
                acquire.rest();
                let result = platform.save(&board.settings());
                let now = platform.now();
                board.step(now, Input::Saved(result), platform);
            }
            Some(Job::ResetSettings { undo }) => {
                acquire.rest();
                let result = platform.reset_settings(undo);
                let now = platform.now();
                board.step(now, Input::SettingsReset(result), platform);
            }
            Some(Job::StoreTable) if TABLES => {
                acquire.rest();
                let result = platform.store_table(&board.piece_to_store());
                let now = platform.now();
                board.step(now, Input::TableStored(result), platform);
            }
            Some(Job::KeepTable(kind)) if TABLES => {
                acquire.rest();
                let result = platform.keep_table(kind, board.piece_to_store().length);
                let now = platform.now();
                board.step(now, Input::TableKept(kind, result), platform);
            }
            Some(Job::Restart) => platform.restart(),
            Some(Job::Examine) => {
                acquire.rest();
                examine(acquire, platform, board);
            }
            Some(Job::Drive(..) | Job::StoreTable | Job::KeepTable(_)) | None => {
                platform.idle(board.wake()).await;
            }
        }
    }
}

fn examine<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    acquire: &mut impl Examine,
    platform: &mut impl Platform,
    board: &mut Board<TAXELS, RUNS, PARTS>,
) {
    let result = acquire.examine(board.circuit());
    let now = platform.now();
    board.step(now, Input::Examined(result), platform);
}

/// Sends pending bytes until none is left or the link accepts no more.
fn send<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    link: &mut impl Link,
    platform: &mut impl Platform,
    board: &mut Board<TAXELS, RUNS, PARTS>,
) {
    loop {
        let now = platform.now();
        let bytes = board.pending(now, platform);
        let wanted = bytes.len();
        let taken = link.try_write(bytes);
        board.sent(taken);
        if wanted == 0 || taken < wanted {
            break;
        }
    }
}

/// Polls a future until it is ready. For hosts, whose scans are ready at once.
pub fn block_on<F: Future>(future: F) -> F::Output {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
    }
}
