//! Temporary files and folders, and flushing of names to the disk.

use crate::error::{Context, Result};
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

/// Creates something in a folder under a unique name. Returns it and its path.
pub fn make<T>(folder: &Path, make: impl Fn(&Path) -> io::Result<T>) -> Result<(T, PathBuf)> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    loop {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("taxel-{}-{number}.part", process::id()));
        match make(&path) {
            // Left by a killed process with this number.
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
        // After a rename there is nothing to remove.
        _ = fs::remove_file(&self.0);
    }
}

/// Renames `from` to `to`, which must not exist; atomically if the system supports it.
pub fn name(from: &Path, to: &Path) -> io::Result<()> {
    let ways = [in_one_step, by_a_second_name];
    for way in ways {
        match way(from, to) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => {}
            done => return done,
        }
    }
    // From here on the name is reserved, and nothing of somebody else's is replaced.
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

/// A kill between the two steps leaves both names.
fn by_a_second_name(from: &Path, to: &Path) -> io::Result<()> {
    fs::hard_link(from, to)?;
    _ = fs::remove_file(from);
    Ok(())
}

/// Exchanges two folders; atomically if the system supports it, so that both names always lead to a folder.
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

/// True if a name is that of a temporary file or folder.
pub fn is_one(name: &Path) -> bool {
    let text = name.to_string_lossy();
    let number = text.strip_prefix("taxel-").and_then(|rest| rest.strip_suffix(".part"));
    number.is_some_and(|number| number.chars().all(|c| c.is_ascii_digit() || c == '-'))
}

/// Flushes the content of a file to the disk. Windows does that only through a handle that may write.
pub(crate) fn sync_file(path: &Path) -> io::Result<()> {
    File::options().write(true).open(path)?.sync_all()
}

/// Flushes the names in a folder to the disk, if the system supports it.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    match File::open(folder)?.sync_all() {
        Err(error) if !matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Err(error),
        _ => Ok(()),
    }
}
