//! Files that are read. A device need not end, and a FIFO waits for whoever writes into it: both are refused.

use crate::error::FileError;
use std::fs::{File, FileType, metadata};
use std::io::Read;
use std::path::Path;

/// Opens a file. Error if it is something else: a folder, a device, a FIFO, a socket.
pub fn open(path: impl AsRef<Path>) -> Result<File, FileError> {
    let path = path.as_ref();
    log::info!("reads {}", path.display());
    let unread = |error| FileError::read(path, error);
    let kind = metadata(path).map_err(unread)?.file_type();
    if !kind.is_file() {
        return Err(FileError::NoFile { path: path.into(), what: what(kind) });
    }
    File::open(path).map_err(unread)
}

/// Reads the bytes of a file.
pub fn bytes(path: impl AsRef<Path>) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    let read = open(&path)?.read_to_end(&mut bytes);
    read.map(|_| bytes).map_err(|error| FileError::read(path.as_ref(), error))
}

/// Reads the text of a file.
pub fn text(path: impl AsRef<Path>) -> Result<String, FileError> {
    let mut text = String::new();
    let read = open(&path)?.read_to_string(&mut text);
    read.map(|_| text).map_err(|error| FileError::read(path.as_ref(), error))
}

/// A path that a file in `folder` names, relative to that folder; what has no extension is a name.
pub fn beside(folder: &Path, named: &str) -> String {
    match Path::new(named).extension() {
        Some(_) => folder.join(named).display().to_string(),
        None => named.to_string(),
    }
}

fn what(kind: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return "a FIFO";
        }
        if kind.is_socket() {
            return "a socket";
        }
    }
    if kind.is_dir() { "a folder" } else { "a device" }
}
