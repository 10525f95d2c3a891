//! The recordings of a folder.

use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// What cannot be looked into: its path, and why.
pub type Unfound = (PathBuf, String);

/// All files of a folder and the folders inside that are called `.mcap`, sorted by their paths, and folders inside
/// that cannot be read. Links to folders are not followed. Error if the folder itself cannot be read.
pub fn recordings(folder: &Path) -> Result<Vec<Result<PathBuf, Unfound>>> {
    let entries =
        std::fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    let mut found = Vec::new();
    let mut open = vec![(folder.to_path_buf(), entries)];
    while let Some((folder, entries)) = open.pop() {
        for entry in entries {
            let entry = match entry.and_then(|entry| Ok((entry.file_type()?, entry.path()))) {
                Ok(entry) => entry,
                Err(error) => {
                    found.push(Err((folder.clone(), error.to_string())));
                    continue;
                }
            };
            match entry {
                (kind, path) if kind.is_dir() => match std::fs::read_dir(&path) {
                    Ok(entries) => open.push((path, entries)),
                    Err(error) => found.push(Err((path, error.to_string()))),
                },
                (_, path) if path.extension().is_some_and(|end| end == "mcap") => found.push(Ok(path)),
                _ => {}
            }
        }
    }
    let path = |found: &Result<PathBuf, Unfound>| match found {
        Ok(path) | Err((path, _)) => path.clone(),
    };
    found.sort_by_cached_key(path);
    Ok(found)
}
