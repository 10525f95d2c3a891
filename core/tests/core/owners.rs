//! The board is made of owners that do not know each other: by the text of their files.

use std::fs::{read_dir, read_to_string};
use std::path::{Path, PathBuf};

/// Files of the owners of the board's state.
const OWNERS: [&str; 11] = [
    "alarms",
    "budget",
    "calibration",
    "folds",
    "jobs",
    "line_tests",
    "rebuilds",
    "scans",
    "surface",
    "tables",
    "taxel_watch",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

fn board() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/board")
}

#[test]
fn no_owner_imports_another() {
    for owner in OWNERS {
        let whole = read_to_string(board().join(owner).with_extension("rs")).unwrap();
        let text = whole.split("#[cfg(test)]").next().unwrap();
        for other in OWNERS.into_iter().filter(|other| *other != owner) {
            for path in [format!("super::{other}"), format!("board::{other}")] {
                assert!(!text.contains(&path), "{owner} imports {other}");
            }
        }
        assert!(!text.contains("super::*") && !text.contains("use super::{"), "{owner}: one import a line");
    }
}

#[test]
fn all_of_a_type_is_in_its_file() {
    let home = |name: &str| board().join(name);
    for (of, file) in [("Board<", home("mod.rs")), ("Outbox<", home("outbox/mod.rs"))] {
        let starts = |line: &str| line.starts_with("impl") && line.contains(&format!("> {of}"));
        let mut found = false;
        for path in sources(&board().join("..")) {
            let has = read_to_string(&path).unwrap().lines().any(starts);
            let is_home = path.canonicalize().unwrap() == file.canonicalize().unwrap();
            assert!(!has || is_home, "{} is implemented in {}", of.trim_end_matches('<'), path.display());
            found |= has;
        }
        assert!(found, "{of} is implemented nowhere");
    }
}
