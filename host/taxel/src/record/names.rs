//! Names of files.

use crate::error::{FileError, Result};
use std::path::{Path, PathBuf};

/// Path of file `number`, from 1: the first as given, then `NAME-0002.mcap`, `NAME-0003.mcap`.
pub fn numbered(path: &Path, number: u32) -> PathBuf {
    if number <= 1 {
        return path.into();
    }
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, extension) = (part(path.file_stem()), part(path.extension()));
    let dot = if extension.is_empty() { "" } else { "." };
    path.with_file_name(format!("{stem}-{number:04}{dot}{extension}"))
}

/// Error if numbered files of this name exist, which a recording in several files would run into.
pub(crate) fn are_free(path: &Path) -> Result<()> {
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let begins = format!("{}-", part(path.file_stem()));
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    // An unreadable folder is reported when the file is created.
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let number = name.strip_prefix(&begins).and_then(|rest| rest.split('.').next()?.parse::<u32>().ok());
        let is_one = |number| {
            let file = numbered(path, number);
            number > 1
                && [&file, &beside(&file)].iter().any(|file| file.file_name() == Some(&entry.file_name()))
        };
        if number.is_some_and(is_one) {
            return Err(FileError::Exists { path: entry.path() }.into());
        }
    }
    Ok(())
}

/// Path of the ROS 2 file beside a recording: `NAME.ros2.mcap`.
pub fn beside(path: &Path) -> PathBuf {
    path.with_extension("ros2.mcap")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_numbered() {
        assert_eq!(numbered(Path::new("a/b.mcap"), 1), Path::new("a/b.mcap"));
        assert_eq!(numbered(Path::new("a/b.mcap"), 12), Path::new("a/b-0012.mcap"));
        assert_eq!(numbered(Path::new("b"), 2), Path::new("b-0002"));
        assert_eq!(beside(Path::new("a/b.mcap")), Path::new("a/b.ros2.mcap"));
    }
}
