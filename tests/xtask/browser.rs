//! Tests the page of `taxel view` in a browser, see tests/browser.

use crate::end::{End, shown};
use crate::targets::test_target;
use crate::{install, paths, process, site};
use std::path::Path;
use std::process::Command;

/// Prefix of log lines with measurements.
const MEASURED: &str = "# view: ";

/// Checks the types of the page, runs all its tests, and prints their measurements.
pub fn check(log: &Path) -> End {
    shown(measured(&[], log, &[])?)
}

/// Measurements printed by the tests in some files; an empty list selects all files.
pub fn measured(files: &[&str], log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    install::browser()?;
    for project in [".", "../../host/site"] {
        let mut types = Command::new("node");
        types.args(["node_modules/typescript/bin/tsc", "-p", project]).current_dir(paths::browser());
        if let Err(why) = process::run_into(&mut types, log) {
            return Ok(Err(why));
        }
    }
    // The tests of the program are built along with it; that of the serial port leaves what the page reads.
    for command in [test_target("program").arg("--no-run"), &mut test_target("serial")] {
        if let Err(why) = process::run_into(command, log) {
            return Ok(Err(why));
        }
    }
    let site = match site::make(log) {
        Ok(site) => site,
        Err(why) => return Ok(Err(why)),
    };
    let program = paths::target().join("debug/taxel").with_extension(std::env::consts::EXE_EXTENSION);
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=tap"]).args(files).current_dir(paths::browser());
    node.env("TAXEL_PROGRAM", program)
        .env("TAXEL_SITE", site)
        .env("TAXEL_WIRE", paths::target().join("tmp"))
        .envs(variables.iter().copied());
    let end = process::run_into(&mut node, log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let lines =
        text.lines().filter_map(|line| line.trim().strip_prefix(MEASURED)).map(String::from).collect();
    Ok(end.map(|()| lines))
}
