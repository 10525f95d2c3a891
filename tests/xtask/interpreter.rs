//! The CPythons of this machine, and what they run first.

use crate::{paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest CPython that the wheel is for, and the newest that it is tested with.
pub const VERSIONS: std::ops::RangeInclusive<u32> = 10..=13;
/// Prints the length of the first image.
const FIRST: &str = "import taxel; \
                     print(next(e.image.size for e in taxel.open('sim:pat') if isinstance(e, taxel.Frame)))";

/// The newest CPython that is there.
pub fn newest() -> Option<String> {
    VERSIONS.rev().find_map(interpreter)
}

/// Name or path of the CPython of this version: on the PATH, or one that pyenv has installed.
pub fn interpreter(minor: u32) -> Option<String> {
    let is_it = |python: &str| version(python).is_some_and(|[_, have]| have == minor);
    let named = format!("python3.{minor}");
    if is_it(&named) {
        return Some(named);
    }
    let root = process::output(Command::new("pyenv").arg("root"))?;
    let folders = std::fs::read_dir(Path::new(&root).join("versions")).ok()?.flatten();
    let pythons = folders.map(|folder| folder.path().join("bin/python").display().to_string());
    pythons.into_iter().find(|python| is_it(python))
}

/// Version of an interpreter.
pub fn version(python: &str) -> Option<[u32; 2]> {
    let reported =
        process::output(Command::new(python).args(["-c", "import sys; print(*sys.version_info[:2])"]))?;
    let mut numbers = reported.split(' ').map(str::parse);
    Some([numbers.next()?.ok()?, numbers.next()?.ok()?])
}

/// Minor version of an interpreter.
pub fn minor(python: &str) -> u32 {
    version(python).map_or(0, |[_, minor]| minor)
}

/// Waits for the first image by an interpreter that has the package.
pub fn first_image(python: &mut Command) -> Result<(), String> {
    let said = process::output(python.args(["-c", FIRST]).current_dir(paths::target()));
    if said.as_deref() == Some("2048") { Ok(()) } else { Err("there was no first image".into()) }
}

/// The package's folder.
pub fn package() -> PathBuf {
    paths::root().join("host/python")
}
