//! `cargo xtask supply`: checks the dependencies' sources, licences and advisories, and writes a list of them
//! for each deliverable.

use crate::{install, pack, paths, process};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Checks of cargo-deny. The advisories need the network, the others do not.
const CHECKS: [&str; 4] = ["licenses", "sources", "bans", ADVISORIES];
const ADVISORIES: &str = "advisories";
/// Its message if the advisories are not available.
const NO_LIST: &str = "failed to fetch advisory database";
/// What the program can do where it is given away: all but Zenoh, which takes the compiler minutes.
pub const FEATURES: &str = "taxel-cli/foxglove,taxel-cli/ros2";

/// A deliverable.
pub struct Given {
    /// Name of its package.
    pub package: &'static str,
    /// Folder of its lock file.
    folder: &'static str,
    /// What it is built with beside its default features.
    features: &'static str,
}

/// All of them.
pub const GIVEN: [Given; 3] = [
    Given { package: "taxel-cli", folder: ".", features: FEATURES },
    Given { package: "taxel-python", folder: ".", features: "taxel-python/full" },
    Given { package: "taxel-firmware", folder: "firmware", features: "default" },
];

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
    for given in &GIVEN {
        println!("what {} is made of: {}", given.package, listed(given)?.display());
    }
    Ok(is_good)
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
fn listed(given: &Given) -> Result<PathBuf, String> {
    let path = paths::target().join(format!("sbom/{}.cdx.json", given.package));
    process::run(pack::command("sbom").args(given.words()).arg(&path))?;
    Ok(path)
}

impl Given {
    /// Its manifest, name and features.
    pub fn words(&self) -> [OsString; 3] {
        let manifest = paths::root().join(self.folder).join("Cargo.toml");
        [manifest.into(), self.package.into(), self.features.into()]
    }
}
