//! Temporary files and folders, and what brings a name to the disk.

use anyhow::{Context, Result};
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

/// Makes something new in a folder under a name of its own; gives it and its path.
pub fn make<T>(folder: &Path, make: impl Fn(&Path) -> io::Result<T>) -> Result<(T, PathBuf)> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    loop {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("taxel-{}-{number}.part", process::id()));
        match make(&path) {
            // Left by a process of this number that was killed.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            made => {
                let place = || format!("nothing can be written in {}", folder.display());
                return Ok((made.with_context(place)?, path));
            }
        }
    }
}

/// Moves what lies at `from` to the name `to`, which must be free.
pub fn name(from: &Path, to: &Path) -> io::Result<()> {
    // Nobody else gets the name from here on, and nothing that somebody else made is replaced.
    File::create_new(to)?;
    fs::rename(from, to).inspect_err(|_| _ = fs::remove_file(to))
}

/// Brings the names in a folder to the disk, where the system has a way to do so.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    match File::open(folder)?.sync_all() {
        Err(error) if !matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Err(error),
        _ => Ok(()),
    }
}
