//! `cargo xtask package`: the crates that others can depend on, packed and built from their packages alone.

use crate::checks::cargo;
use crate::targets::End;
use crate::{paths, process};
use std::path::Path;
use std::process::Command;

/// The published crates, in the order in which they depend on each other.
const PUBLISHED: [&str; 5] = ["taxel-core", "taxel-store", "taxel-sim", "taxel", "taxel-cli"];

/// Packs them; changes that are not committed are packed, too.
fn packing() -> Command {
    let mut command = cargo(&["package", "--quiet", "--allow-dirty"], paths::root());
    command.args(PUBLISHED.iter().flat_map(|name| ["--package", *name]));
    command
}

/// Packs them and builds each from its package.
pub fn run() -> Result<(), String> {
    process::run(&mut packing())
}

/// Packs them only: a file, a version or a description that is missing is found in a second.
pub fn check(log: &Path) -> End {
    Ok(process::run_into(packing().arg("--no-verify"), log))
}
