//! An output folder.

use super::force::Force;
use super::named::folder as parent;
use super::part;
use super::same::is_same;
use crate::error::{Context, FileError, Result, UsageError};
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Content of a folder being written, in a temporary folder. If it is dropped without [`Folder::keep`], the
/// folder stays as before.
#[derive(Debug)]
pub struct Folder {
    name: PathBuf,
    /// Path without links.
    path: PathBuf,
    /// Temporary folder of the content: beside the folder, or inside it if nothing can be created beside it.
    part: PathBuf,
    force: Force,
    ours: fn(&Path) -> bool,
}

impl Folder {
    /// Begins a folder that does not exist or is empty; with `--force` also one with only files of such an
    /// output, as recognised by `ours` from their paths inside the folder. `inputs` are the files that the
    /// command reads.
    pub fn begin<P: AsRef<Path>>(
        name: &Path,
        force: impl Into<Force>,
        inputs: impl IntoIterator<Item = P>,
        ours: fn(&Path) -> bool,
    ) -> Result<Folder> {
        let (shown, place) = (name.display(), || format!("{} cannot be written", name.display()));
        if name == Path::new("-") {
            fail!(
                UsageError::Argument,
                "-o -: a folder cannot be written to the standard output, name a folder"
            );
        }
        let path = place_of(name).with_context(place)?;
        if path.exists() && !path.is_dir() {
            fail!(FileError::Output, "{shown} is a file: name a folder");
        }
        for input in inputs.into_iter().filter_map(|input| fs::canonicalize(input).ok()) {
            if input.ancestors().any(|folder| is_same(folder, &path)) {
                fail!(
                    FileError::Output,
                    "{shown} is the folder of {}, which this command reads: name another",
                    input.display()
                );
            }
        }
        let mut folder = Folder { name: name.into(), path, part: PathBuf::new(), force: force.into(), ours };
        folder.may_be_replaced()?;
        folder.part = temporary(&folder.path).with_context(place)?;
        Ok(folder)
    }

    /// Error if the folder has files of other kinds, which would be lost.
    fn may_be_replaced(&self) -> Result<()> {
        let shown = self.name.display();
        for file in files(&self.path).with_context(|| format!("{shown} cannot be written"))? {
            if !self.force.force {
                fail!(
                    FileError::Output,
                    "{shown} is not empty: name another folder, or --force to replace its content"
                );
            }
            let inside = file.strip_prefix(&self.path).unwrap_or(&file);
            if !(self.ours)(inside) {
                fail!(
                    FileError::Output,
                    "{shown} contains {}, which is not part of such an output: name another folder",
                    inside.display()
                );
            }
        }
        Ok(())
    }

    /// Creates a file inside the folder, with its parent folders.
    pub fn file(&self, inside: impl AsRef<Path>) -> Result<BufWriter<File>> {
        let path = self.part.join(&inside);
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        fs::create_dir_all(parent(&path)).with_context(place)?;
        File::create_new(path).map(BufWriter::new).with_context(place)
    }

    /// Creates a folder inside the folder.
    pub fn folder(&self, inside: impl AsRef<Path>) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        fs::create_dir_all(self.part.join(&inside)).with_context(place)
    }

    /// Writes a small file inside the folder; its parent folder exists.
    pub fn small_file(&self, inside: impl AsRef<Path>, content: &[u8]) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        let mut file = File::create_new(self.part.join(&inside)).with_context(place)?;
        file.write_all(content).with_context(place)
    }

    /// Puts the content in place; it is on the disk when this returns.
    pub fn keep(self) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.display());
        for file in files(&self.part).with_context(place)? {
            part::sync_file(&file).with_context(place)?;
        }
        self.keep_unsynced()
    }

    /// Puts the content in place without waiting for the disk: for a great number of small files that can be
    /// made again.
    pub fn keep_unsynced(mut self) -> Result<()> {
        let shown = self.name.display().to_string();
        let place = || format!("{shown} cannot be written");
        // Files or a link may have appeared since the first check.
        if fs::symlink_metadata(&self.path).is_ok_and(|known| !known.is_dir()) {
            fail!(FileError::Output, "{}: it has become a link or a file meanwhile", place());
        }
        self.may_be_replaced()?;
        if self.part.starts_with(&self.path) {
            self.move_inside().with_context(place)?;
        } else {
            self.take_place().with_context(place)?;
        }
        part::sync_folder(parent(&self.part)).with_context(place)?;
        log::info!("has written {shown}");
        let left = || format!("{shown} is written, but {} is left", self.part.display());
        remove(&self.part).with_context(left)
    }

    /// Exchanges the names of the folder and the temporary one.
    fn take_place(&self) -> io::Result<()> {
        let Ok(old) = fs::metadata(&self.path) else { return fs::rename(&self.part, &self.path) };
        // The permissions are kept.
        fs::set_permissions(&self.part, old.permissions())?;
        part::exchange(&self.part, &self.path)
    }

    /// Exchanges the content. If a file cannot be moved, those moved before are moved back.
    fn move_inside(&mut self) -> Result<()> {
        let (_, aside) = part::make(&self.part, |aside| fs::create_dir(aside))?;
        let is_content = |entry: &PathBuf| *entry != aside && !is_temporary(entry);
        let (mut old, mut new) = (entries(&self.path)?, entries(&self.part)?);
        old.retain(is_content);
        new.retain(is_content);
        let moves =
            old.iter().map(|entry| (entry, &aside)).chain(new.iter().map(|entry| (entry, &self.path)));
        let mut moved = Vec::new();
        for (from, folder) in moves {
            let to = folder.join(from.file_name().unwrap_or_default());
            if let Err(error) = fs::rename(from, &to) {
                let back = |(from, to): &(&PathBuf, PathBuf)| fs::rename(to, from);
                if moved.iter().rev().try_for_each(back).is_err() {
                    // It may hold the only copy of the old content.
                    let left = std::mem::take(&mut self.part);
                    return Err(error).with_context(|| format!("what it held is in {}", left.display()));
                }
                return Err(error.into());
            }
            moved.push((from, to));
        }
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        _ = remove(&self.part);
    }
}

/// Path without links of an existing folder, or of a new one in a folder that is created now if needed.
fn place_of(name: &Path) -> Result<PathBuf> {
    if name.exists() {
        return Ok(fs::canonicalize(name)?);
    }
    if fs::symlink_metadata(name).is_ok() {
        fail!(FileError::Output, "it is a link to what does not exist: name that");
    }
    let last = name.file_name().ok_or_else(|| error!(FileError::Output, "it names no folder"))?;
    let around = name.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    fs::create_dir_all(around)?;
    Ok(fs::canonicalize(around)?.join(last))
}

/// Creates a temporary folder beside `path`, from which it can be renamed; else inside.
fn temporary(path: &Path) -> Result<PathBuf> {
    let make = |folder: &Path| part::make(folder, |part| fs::create_dir(part)).map(|(_, part)| part);
    match make(parent(path)) {
        Ok(part) if !path.exists() || is_on_one_disk(&part, path) => Ok(part),
        Err(error) if !path.exists() => Err(error),
        beside => {
            _ = beside.map(fs::remove_dir);
            make(path)
        }
    }
}

#[cfg(unix)]
fn is_on_one_disk(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    matches!((fs::metadata(a), fs::metadata(b)), (Ok(a), Ok(b)) if a.dev() == b.dev())
}

#[cfg(not(unix))]
fn is_on_one_disk(_: &Path, _: &Path) -> bool {
    true
}

/// Removes a temporary folder if it still exists, with a second attempt.
fn remove(part: &Path) -> io::Result<()> {
    match fs::remove_dir_all(part).or_else(|_| fs::remove_dir_all(part)) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// True if a kill has left it, or another process is writing it.
fn is_temporary(entry: &Path) -> bool {
    entry.file_name().is_some_and(|name| part::is_one(Path::new(name)))
}

fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
}

/// All files in a folder and its subfolders, without following links; none if the folder does not exist.
/// Leftovers of killed commands are ignored.
fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    if !folder.exists() {
        return Ok(found);
    }
    for entry in entries(folder)? {
        if is_temporary(&entry) {
            continue;
        }
        if fs::symlink_metadata(&entry)?.is_dir() {
            found.extend(files(&entry)?);
        } else {
            found.push(entry);
        }
    }
    Ok(found)
}
