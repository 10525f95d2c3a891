//! The board's loop, shared by firmware, host and tests.

mod reader;
mod services;

pub use services::{Link, Platform};

use crate::acquire::Acquire;
use crate::board::{Board, Input, Job, TableKind};
use crate::pipeline::Stage;
use crate::selftest::Examine;
use core::future::Future;
use core::pin::pin;
use core::task::{Context, Poll, Waker};
use reader::Reader;

/// True if this build has a use for tables.
const TABLES: bool = !TableKind::USED.is_empty();

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
        if let Some(start) = link.start_of_frame(board.asks_start_of_frame()) {
            let now = platform.now();
            board.step(now, Input::StartOfFrame(start), platform);
        }
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
