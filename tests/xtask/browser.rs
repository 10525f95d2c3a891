//! The page of `taxel view` in a browser, see tests/browser.

use crate::targets::{End, shown, test_target};
use crate::{install, paths, process};
use std::path::Path;
use std::process::Command;

/// What a line of the log begins with that is measured.
const MEASURED: &str = "# view: ";

/// Every test of the page; what it measured is shown.
pub fn check(log: &Path) -> End {
    shown(measured(&[], log, &[])?)
}

/// What the tests in some files print, or in all.
pub fn measured(files: &[&str], log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    install::browser()?;
    // The tests of the program are built together with it.
    if let Err(why) = process::run_into(test_target("program").arg("--no-run"), log) {
        return Ok(Err(why));
    }
    let program = paths::target().join("debug/taxel").with_extension(std::env::consts::EXE_EXTENSION);
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=tap"]).args(files).current_dir(paths::browser());
    node.env("TAXEL_PROGRAM", program).envs(variables.iter().copied());
    let end = process::run_into(&mut node, log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let lines =
        text.lines().filter_map(|line| line.trim().strip_prefix(MEASURED)).map(String::from).collect();
    Ok(end.map(|()| lines))
}
