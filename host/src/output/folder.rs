//! A folder that is going to be written.

use super::file::folder as parent;
use super::force::Force;
use super::part;
use super::same::is_same;
use crate::fault::Fault;
use crate::verbose;
use anyhow::{Context, Result, bail};
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The content of a folder that is being written, in a temporary folder inside it. Dropped without [`Folder::keep`], the
/// folder is as it was before.
#[derive(Debug)]
pub struct Folder {
    name: PathBuf,
    /// Its path without links.
    path: PathBuf,
    /// Where its content lies until it is complete.
    part: PathBuf,
    /// It was not there before.
    is_new: bool,
}

impl Folder {
    /// Begins a folder that does not exist or is empty; with `--force` one that holds nothing but files of which `ours`,
    /// told their paths inside the folder, says that they are such an output's. `inputs` are the files that the command
    /// reads.
    pub fn begin<P: AsRef<Path>>(
        name: &Path,
        force: Force,
        inputs: impl IntoIterator<Item = P>,
        ours: fn(&Path) -> bool,
    ) -> Result<Folder> {
        let (shown, place) = (name.display(), || format!("{} cannot be written", name.display()));
        if name == Path::new("-") {
            bail!(Fault::usage("-o -: a folder cannot be written to the standard output, name a folder"));
        }
        let is_new = !name.exists();
        if is_new {
            fs::create_dir_all(name).with_context(place)?;
        } else if !name.is_dir() {
            bail!("{shown} is a file: name a folder");
        }
        let path = fs::canonicalize(name).with_context(place)?;
        for input in inputs.into_iter().filter_map(|input| fs::canonicalize(input).ok()) {
            if input.ancestors().any(|folder| is_same(folder, &path)) {
                bail!("{shown} is the folder of {}, which this command reads: name another", input.display());
            }
        }
        for file in files(&path).with_context(place)? {
            if !force.force {
                bail!("{shown} is not empty: name another folder, or --force to replace its content");
            }
            let inside = file.strip_prefix(&path)?;
            if !ours(inside) {
                bail!("{shown} holds {}, which is no such output: name another folder", inside.display());
            }
        }
        let (_, part) = part::make(&path, |part| fs::create_dir(part)).with_context(place)?;
        Ok(Folder { name: name.into(), path, part, is_new })
    }

    /// Begins a file inside it; folders on the way are made.
    pub fn file(&self, inside: impl AsRef<Path>) -> Result<BufWriter<File>> {
        let path = self.part.join(&inside);
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        fs::create_dir_all(parent(&path)).with_context(place)?;
        File::create_new(path).map(BufWriter::new).with_context(place)
    }

    /// Makes a folder inside it.
    pub fn folder(&self, inside: impl AsRef<Path>) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        fs::create_dir_all(self.part.join(&inside)).with_context(place)
    }

    /// Writes a small file inside it at once; its folder is there.
    pub fn small_file(&self, inside: impl AsRef<Path>, content: &[u8]) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.join(&inside).display());
        let mut file = File::create_new(self.part.join(&inside)).with_context(place)?;
        file.write_all(content).with_context(place)
    }

    /// Puts the content in its place: it is on the disk when this returns.
    pub fn keep(self) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.display());
        for file in files(&self.part).with_context(place)? {
            File::open(file).and_then(|file| file.sync_all()).with_context(place)?;
        }
        self.keep_unsynced()
    }

    /// Puts the content in its place and leaves it to the system when it reaches the disk: for very many small files that
    /// can be made again, each of which would be waited for.
    pub fn keep_unsynced(self) -> Result<()> {
        let place = || format!("{} cannot be written", self.name.display());
        let (_, old) = part::make(&self.path, |old| fs::create_dir(old)).with_context(place)?;
        for entry in entries(&self.path).with_context(place)? {
            if entry != self.part && entry != old {
                move_into(&entry, &old).with_context(place)?;
            }
        }
        for entry in entries(&self.part).with_context(place)? {
            move_into(&entry, &self.path).with_context(place)?;
        }
        part::sync_folder(&self.path).with_context(place)?;
        verbose::tell(format_args!("has written {}", self.name.display()));
        fs::remove_dir_all(&old).with_context(place)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.part);
        if self.is_new {
            // Only where it is empty.
            _ = fs::remove_dir(&self.path);
        }
    }
}

fn move_into(entry: &Path, folder: &Path) -> std::io::Result<()> {
    entry.file_name().map_or(Ok(()), |name| fs::rename(entry, folder.join(name)))
}

fn entries(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
}

/// All files in a folder and in those in it; links are not followed.
fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in entries(folder)? {
        if fs::symlink_metadata(&entry)?.is_dir() {
            found.extend(files(&entry)?);
        } else {
            found.push(entry);
        }
    }
    Ok(found)
}
