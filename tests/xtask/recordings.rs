//! Folders of recordings: TAXEL_DATA, a list like PATH.

use std::ffi::{OsStr, OsString};

/// Name of the variable.
pub const VARIABLE: &str = "TAXEL_DATA";

/// The list with absolute paths; none if it is empty.
pub fn listed() -> Option<OsString> {
    absolute(&std::env::var_os(VARIABLE).filter(|listed| !listed.is_empty())?)
}

/// Cargo starts each test in its package's folder, so relative entries would not work.
fn absolute(listed: &OsStr) -> Option<OsString> {
    let absolute = |folder| std::path::absolute(&folder).unwrap_or(folder);
    std::env::join_paths(std::env::split_paths(listed).map(absolute)).ok()
}

/// Checks that every listed folder exists.
pub fn at_hand() -> Result<(), String> {
    let listed = listed().ok_or_else(|| format!("{VARIABLE} lists no folders of recordings"))?;
    let missing = std::env::split_paths(&listed).find(|folder| !folder.is_dir());
    missing.map_or(Ok(()), |folder| Err(format!("{VARIABLE}: there is no folder {}", folder.display())))
}

#[test]
fn folders_are_found_from_wherever_a_test_runs() {
    let here = std::env::current_dir().unwrap();
    let listed = absolute(OsStr::new("../data:/reference")).unwrap();
    let folders: Vec<_> = std::env::split_paths(&listed).collect();
    assert_eq!(folders, [here.join("../data"), "/reference".into()]);
}
