//! The rows of the table, read by all cores.

use super::found::Unfound;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use taxel::record::BoardSummary;
use taxel::tell::progress::{Progress, Unit};
use taxel::tell::words;

/// A board of a recording, or what cannot be read.
#[derive(Debug, Clone)]
pub struct IndexRow {
    /// Path in the folder, with `/`.
    pub file: String,
    /// What the recording says, or why it cannot be read.
    pub read: Result<BoardSummary, String>,
}

/// Reads all recordings. Rows are in the order of the files.
pub fn read(folder: &Path, found: Vec<Result<PathBuf, Unfound>>) -> Vec<IndexRow> {
    let next = AtomicUsize::new(0);
    let total = Some(found.len() as u64);
    let done = Mutex::new((
        found.iter().map(|_| Vec::new()).collect::<Vec<_>>(),
        Progress::of(format!("reading {}", folder.display()), Unit::Steps("recordings"), total),
        0,
    ));
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(found) = found.get(number) else { return };
            let rows = rows(folder, found);
            // Nothing panics while it is held.
            let Ok(mut done) = done.lock() else { return };
            done.0[number] = rows;
            done.2 += 1;
            let count = done.2;
            done.1.at(count);
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    let (rows, ..) = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    rows.into_iter().flatten().collect()
}

/// The rows of a recording.
fn rows(folder: &Path, found: &Result<PathBuf, Unfound>) -> Vec<IndexRow> {
    let (path, read) = match found {
        Ok(path) => (path, BoardSummary::read(path).map_err(|error| words::sentence(&error))),
        Err((path, why)) => (path, Err(format!("{} cannot be read: {why}", path.display()))),
    };
    let inside = path.strip_prefix(folder).unwrap_or(path);
    let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
    let row = |read| IndexRow { file: parts.join("/"), read };
    match read {
        Ok(boards) => boards.into_iter().map(|board| row(Ok(board))).collect(),
        Err(why) => vec![row(Err(why))],
    }
}
