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

/// A temporary file, removed when dropped.
#[derive(Debug)]
pub struct Part(pub PathBuf);

impl Drop for Part {
    fn drop(&mut self) {
        // Where it has the output's name by now, there is none.
        _ = fs::remove_file(&self.0);
    }
}

/// Moves what lies at `from` to the name `to`, which must be free, in one step where the system has a way to do
/// so.
pub fn name(from: &Path, to: &Path) -> io::Result<()> {
    let ways = [in_one_step, by_a_second_name];
    for way in ways {
        match way(from, to) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => {}
            done => return done,
        }
    }
    // Nobody else gets the name from here on, and nothing that somebody else made is replaced.
    File::create_new(to)?;
    fs::rename(from, to).inspect_err(|_| _ = fs::remove_file(to))
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn in_one_step(from: &Path, to: &Path) -> io::Result<()> {
    use nix::fcntl::{AT_FDCWD, RenameFlags, renameat2};
    Ok(renameat2(AT_FDCWD, from, AT_FDCWD, to, RenameFlags::RENAME_NOREPLACE)?)
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn in_one_step(_: &Path, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

/// A kill between the two leaves both names.
fn by_a_second_name(from: &Path, to: &Path) -> io::Result<()> {
    fs::hard_link(from, to)?;
    _ = fs::remove_file(from);
    Ok(())
}

/// Exchanges two folders, so that both names lead to a folder at any time where the system has a way to do so.
pub fn exchange(new: &Path, old: &Path) -> io::Result<()> {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        use nix::fcntl::{AT_FDCWD, RenameFlags, renameat2};
        if renameat2(AT_FDCWD, new, AT_FDCWD, old, RenameFlags::RENAME_EXCHANGE).is_ok() {
            return Ok(());
        }
    }
    let aside = new.with_extension("old.part");
    fs::rename(old, &aside)?;
    fs::rename(new, old).inspect_err(|_| _ = fs::rename(&aside, old))?;
    fs::rename(&aside, new)
}

/// Whether a name is that of a temporary file or folder.
pub fn is_one(name: &Path) -> bool {
    let text = name.to_string_lossy();
    let number = text.strip_prefix("taxel-").and_then(|rest| rest.strip_suffix(".part"));
    number.is_some_and(|number| number.chars().all(|c| c.is_ascii_digit() || c == '-'))
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
