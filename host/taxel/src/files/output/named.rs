//! The name of an output, and how a temporary file gets it.

use super::force::Force;
use super::part;
use super::place::Place;
use super::same::is_same;
use crate::error::{Context, Error, FileError, Result, UsageError};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Name of an output, what it leads to, and whether it may be taken.
#[derive(Debug)]
pub struct Named {
    /// Name as given by the user.
    pub name: PathBuf,
    /// Place to which it leads.
    pub place: Place,
    /// Files that the command reads.
    pub inputs: Vec<PathBuf>,
    /// Permission to replace an existing file.
    pub force: Force,
}

impl Named {
    /// Error if it is an input; it may have become one since the first check.
    pub(crate) fn is_no_input(&self) -> Result<()> {
        let Place::File(path, _) = &self.place else { return Ok(()) };
        let Some(same) = self.inputs.iter().find(|input| is_same(path, input)) else { return Ok(()) };
        let name = self.name.display();
        if *same == self.name {
            fail!(UsageError::Argument, "{name} is read by this command: give another name for the output");
        }
        let same = same.display();
        let reported =
            format!("{name} is the same file as {same}, which this command reads: give another name");
        fail!(UsageError::Argument, "{}", reported)
    }

    /// Renames a temporary file to the output's name.
    pub(crate) fn take_name(&self, part: &Path) -> Result<()> {
        let Place::File(path, existed) = &self.place else { return Ok(()) };
        let place = || format!("{} cannot be written", self.name.display());
        self.is_no_input()?;
        if self.force.force {
            if let (true, Ok(old)) = (existed, fs::metadata(path)) {
                // The permissions are kept.
                fs::set_permissions(part, old.permissions()).with_context(place)?;
            }
            fs::rename(part, path).with_context(place)?;
        } else {
            part::name(part, path).map_err(|error| match error.kind() {
                ErrorKind::AlreadyExists => exists(&self.name),
                _ => Error::from(error).context(place()),
            })?;
        }
        part::sync_folder(folder(path)).with_context(place)
    }
}

/// Error about a file that may not be replaced.
pub fn exists(name: &Path) -> Error {
    FileError::Exists { path: name.into() }.into()
}

/// Folder of a path found by [`Place::of`].
pub fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(path)
}
