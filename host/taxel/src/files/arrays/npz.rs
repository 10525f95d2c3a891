//! An archive of NumPy arrays.

use super::room::Room;
use super::{Frames, npy};
use crate::error::{ArrayError, Context, Result, UsageError};
use std::fs::File;
use std::io::{BufReader, Read};
use zip::ZipArchive;

/// Suffix of an array's file name.
const ENDING: &str = ".npy";
/// Most memory for the frames of all arrays beyond the size of the archive, because a few megabytes may
/// expand to gigabytes.
const BEYOND: u64 = 128 << 20;

/// An open archive.
pub struct Archive {
    archive: ZipArchive<BufReader<File>>,
    /// Names of all its arrays, in order.
    names: Vec<String>,
    room: Room,
}

impl Archive {
    /// Reads the table of contents.
    pub fn open(file: File) -> Result<Archive> {
        let room = Room::of(file.metadata().context("cannot be read")?.len(), BEYOND);
        let archive = ZipArchive::new(BufReader::new(file));
        let archive = archive.map_err(|error| ArrayError::NotAnArray(error.to_string()));
        let archive = archive.context("not a NumPy archive")?;
        let files: Vec<_> = archive
            .file_names()
            .collect::<Result<_, _>>()
            .map_err(|error| ArrayError::Damaged(error.to_string()))
            .context("damaged")?;
        let arrays = files.iter().filter_map(|name| name.strip_suffix(ENDING));
        let mut names: Vec<String> = arrays.map(String::from).collect();
        names.sort();
        Ok(Archive { archive, names, room })
    }

    /// Reads the array with this name.
    pub fn named(&mut self, name: &str) -> Result<Frames> {
        if !self.names.iter().any(|known| known == name) {
            fail!(UsageError::Unknown, "there is no array {name}; known are {}", listed(&self.names));
        }
        let mut room = self.room;
        let frames = self.entry(name, |entry, size| npy::read(entry, size, &mut room));
        self.room = room;
        frames.with_context(|| format!("array {name}"))
    }

    /// Names of all arrays, in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Reads the one-dimensional array with this name, if it exists.
    pub fn list(&mut self, name: &str) -> Result<Option<Vec<u16>>> {
        self.known(name, |entry, size| npy::list(entry, size))
    }

    /// Reads the texts with this name, if they exist.
    pub fn texts(&mut self, name: &str) -> Result<Option<Vec<String>>> {
        self.known(name, |entry, _| npy::texts(entry))
    }

    /// Applies `read` to an array, if it exists.
    fn known<T>(
        &mut self,
        name: &str,
        read: impl FnOnce(&mut dyn Read, u64) -> Result<T>,
    ) -> Result<Option<T>> {
        if !self.names.iter().any(|known| known == name) {
            return Ok(None);
        }
        self.entry(name, read).with_context(|| format!("array {name}")).map(Some)
    }

    /// Reads the only array, or the only one whose shape is that of frames.
    pub fn only(&mut self) -> Result<Frames> {
        let candidates = if self.names.len() == 1 { self.names.clone() } else { self.candidates()? };
        match candidates.as_slice() {
            [name] => self.named(name),
            [] => fail!(ArrayError::NotAnArray, "holds no array [frames, rows, columns] or [rows, columns]"),
            several => {
                fail!(
                    UsageError::Unknown,
                    "holds several arrays, choose one with --array: {}",
                    listed(several)
                )
            }
        }
    }

    /// Reads all arrays whose shape is that of frames.
    pub fn all(&mut self) -> Result<Vec<(String, Frames)>> {
        let candidates = self.candidates()?;
        if candidates.is_empty() {
            fail!(ArrayError::NotAnArray, "holds no array [frames, rows, columns] or [rows, columns]");
        }
        candidates.into_iter().map(|name| self.named(&name).map(|frames| (name, frames))).collect()
    }

    /// Names of the arrays of two to four dimensions.
    fn candidates(&mut self) -> Result<Vec<String>> {
        let mut candidates = Vec::new();
        for name in self.names.clone() {
            let dimensions = self.entry(&name, |entry, _| npy::dimensions(entry));
            if (2..=4).contains(&dimensions.with_context(|| format!("array {name}"))?) {
                candidates.push(name);
            }
        }
        Ok(candidates)
    }

    /// Applies `read` to an entry's reader and size.
    fn entry<T>(&mut self, name: &str, read: impl FnOnce(&mut dyn Read, u64) -> Result<T>) -> Result<T> {
        let entry = self.archive.by_name(&format!("{name}{ENDING}"));
        let mut entry = entry.map_err(|error| error!(ArrayError::Damaged, "damaged: {error}"))?;
        let size = entry.size();
        read(&mut entry, size)
    }
}

/// Names for a sentence, shortened if there are many.
fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    match names.len().checked_sub(MOST) {
        Some(more @ 1..) => format!("{} and {more} more", names[..MOST].join(", ")),
        _ => names.join(", "),
    }
}
