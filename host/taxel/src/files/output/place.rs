//! Resolves the name of an output.

use crate::error::{Context, FileError, Result};
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Destination of a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// `-`: the standard output.
    Standard,
    /// A terminal, a pipe, `/dev/null`: it cannot be replaced.
    Device(PathBuf),
    /// A file, by its path without links, and whether it exists.
    File(PathBuf, bool),
}

impl Place {
    /// Resolves a name. Error if no file can be written there.
    pub fn of(name: &Path) -> Result<Place> {
        if name == Path::new("-") {
            return Ok(Place::Standard);
        }
        let shown = name.display();
        let known = match fs::metadata(name) {
            Ok(known) => known,
            Err(error) if error.kind() == ErrorKind::NotFound => return new(name),
            Err(error) => return Err(error).with_context(|| format!("{shown} cannot be written")),
        };
        if known.is_dir() {
            fail!(FileError::Output, "{shown} is a folder: name a file");
        }
        if !known.is_file() {
            return taken(name, known.file_type());
        }
        if known.permissions().readonly() {
            fail!(FileError::Output, "{shown} is read-only: give another name");
        }
        let path = fs::canonicalize(name).with_context(|| format!("{shown} cannot be written"))?;
        Ok(Place::File(path, true))
    }
}

/// A new file in an existing folder.
fn new(name: &Path) -> Result<Place> {
    let shown = name.display();
    if fs::symlink_metadata(name).is_ok() {
        fail!(FileError::Output, "{shown} is a link to a file that does not exist: name that file");
    }
    let text = name.to_string_lossy();
    let (Some(last), false) = (name.file_name(), text.ends_with(std::path::is_separator)) else {
        fail!(FileError::Output, "\"{shown}\" names no file");
    };
    let folder = match name.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let real = fs::canonicalize(folder)
        .with_context(|| format!("{shown} cannot be written: the folder {}", folder.display()))?;
    Ok(Place::File(real.join(last), false))
}

/// Opens a device. Error if a file has replaced it meanwhile, which would be overwritten.
pub fn device(path: &Path) -> Result<File> {
    let file = File::options().write(true).open(path)?;
    require!(!file.metadata()?.is_file(), FileError::Output, "it was a device, and is a file now");
    Ok(file)
}

/// A device that accepts a stream of bytes.
#[cfg(unix)]
fn taken(name: &Path, kind: fs::FileType) -> Result<Place> {
    use std::os::unix::fs::FileTypeExt;
    if kind.is_block_device() || kind.is_socket() {
        fail!(FileError::Output, "{} is a disk or a socket: name a file", name.display());
    }
    Ok(Place::Device(name.into()))
}

#[cfg(not(unix))]
fn taken(name: &Path, _: fs::FileType) -> Result<Place> {
    Ok(Place::Device(name.into()))
}
