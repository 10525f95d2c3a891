//! Calls the script that packs, lists and compares what is given away.

use crate::paths;
use std::process::Command;

/// `tests/release/pack.py` with a task, whose words are to be added.
pub fn command(task: &str) -> Command {
    let mut command = Command::new("python3");
    command.arg(paths::root().join("tests/release/pack.py")).arg(task).current_dir(paths::root());
    command
}
