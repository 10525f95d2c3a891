//! Cargo, called for the whole workspace.

use std::path::PathBuf;
use std::process::Command;

/// Options shared by all builds of the workspace, so that they reuse each other's products: cargo unifies the
/// features of dependencies over all selected packages and targets. All features but `zenoh`, which takes the
/// compiler minutes: the packages that have features list the others as `full`.
pub const WHOLE: &[&str] = &["--workspace", "--features", "full"];

/// Cargo in a folder, without incremental builds unless the user enables them: writing their data takes
/// longer than it saves here.
pub fn cargo(args: &[&str], folder: PathBuf) -> Command {
    let mut command = Command::new("cargo");
    command.args(args).current_dir(folder);
    without_increments(&mut command);
    command
}

/// Makes a command that calls cargo build like [`cargo`]: what is built otherwise is built once more.
pub fn without_increments(command: &mut Command) {
    if std::env::var_os("CARGO_INCREMENTAL").is_none() {
        command.env("CARGO_INCREMENTAL", "0");
    }
}
