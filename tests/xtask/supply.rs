//! `cargo xtask supply`: checks the dependencies' sources, licences and advisories, and writes a list of them
//! for each deliverable.

use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Checks of cargo-deny. The advisories need the network, the others do not.
const CHECKS: [&str; 4] = ["licenses", "sources", "bans", ADVISORIES];
const ADVISORIES: &str = "advisories";
/// Its message if the advisories are not available.
const NO_LIST: &str = "failed to fetch advisory database";
/// Deliverables, and the folders of their lock files.
const GIVEN: [(&str, &str); 3] = [("taxel-cli", "."), ("taxel-python", "."), ("taxel-firmware", "firmware")];

/// Result of a check.
#[derive(Debug, PartialEq, Eq)]
enum End {
    Passed,
    Failed,
    NotRun,
}

/// Runs all checks, and writes the lists. Returns true if nothing is wrong, and all checks ran or may be
/// missed.
pub fn run(args: &[String]) -> Result<bool, String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let may_miss = match args[..] {
        [] => false,
        ["--may-miss", ADVISORIES] => true,
        _ => return Err(crate::USAGE.into()),
    };
    let deny = install::cargo_tool("cargo-deny", "0.20.2").map_err(|why| format!("not run: {why}"))?;
    let log = paths::log("supply")?;
    let mut is_good = true;
    for (name, folder) in [("the workspace", paths::root())].into_iter().chain(paths::apart()) {
        for check in CHECKS {
            let end = asked(&deny, &folder.join("Cargo.toml"), check, &log);
            println!("{name}: {check}: {}", end.words());
            is_good &= end == End::Passed || end == End::NotRun && may_miss;
        }
    }
    println!("all that was said: {}", log.display());
    for (package, list) in lists()? {
        println!("what {package} is made of: {}", list.display());
    }
    Ok(is_good)
}

/// Writes the list of each deliverable; returns its package and the list.
pub fn lists() -> Result<Vec<(&'static str, PathBuf)>, String> {
    GIVEN.into_iter().map(|(package, folder)| Ok((package, listed(package, folder)?))).collect()
}

impl End {
    fn words(&self) -> &'static str {
        match self {
            End::Passed => "passed",
            End::Failed => "FAILED",
            End::NotRun => "not run: the list of advisories cannot be had",
        }
    }
}

/// Runs cargo-deny on the dependencies of a package.
fn asked(deny: &Path, manifest: &Path, check: &str, log: &Path) -> End {
    let mut command = Command::new(deny);
    command.args(["--locked", "--manifest-path"]).arg(manifest);
    command.arg("--config").arg(paths::root().join("deny.toml")).args([
        "check",
        "--hide-inclusion-graph",
        check,
    ]);
    let said = || std::fs::read_to_string(log).unwrap_or_default();
    let before = said().len();
    match process::run_into(&mut command, log) {
        Ok(()) => End::Passed,
        Err(_) if check == ADVISORIES && said().get(before..).is_some_and(|said| said.contains(NO_LIST)) => {
            End::NotRun
        }
        Err(_) => End::Failed,
    }
}

/// Writes the list of a package's dependencies, in CycloneDX format.
fn listed(package: &str, folder: &str) -> Result<PathBuf, String> {
    let tool = install::cargo_tool("cargo-sbom", "0.10.0").map_err(|why| format!("not run: {why}"))?;
    let mut command = Command::new(tool);
    command.args(["sbom", "--output-format", "cyclone_dx_json_1_6", "--cargo-package", package]);
    command.arg("--project-directory").arg(paths::root().join(folder));
    let list = process::output(&mut command).ok_or(format!("`{}` failed", process::shown(&command)))?;
    let path = paths::target().join(format!("sbom/{package}.cdx.json"));
    let write = || {
        std::fs::create_dir_all(path.parent().expect("it lies in a folder"))?;
        std::fs::write(&path, list)
    };
    write().map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}
