//! Where recordings lie: the folders of TAXEL_DATA, listed as PATH lists folders.

use std::ffi::{OsStr, OsString};

/// The variable that lists them.
pub const VARIABLE: &str = "TAXEL_DATA";

/// The list as tests can use it. An empty one is none.
pub fn listed() -> Option<OsString> {
    absolute(&std::env::var_os(VARIABLE).filter(|listed| !listed.is_empty())?)
}

/// Cargo starts each test in its package's folder, so no entry may depend on where one stands.
fn absolute(listed: &OsStr) -> Option<OsString> {
    let absolute = |folder| std::path::absolute(&folder).unwrap_or(folder);
    std::env::join_paths(std::env::split_paths(listed).map(absolute)).ok()
}

/// Whether every folder that is listed is there.
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
