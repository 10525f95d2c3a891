//! `cargo xtask campaign --only zenoh`: boards between machines (`tests/zenoh`), on network namespaces, with routers
//! by Zenoh's own Python package. No check compiles Zenoh; this does.

use crate::cargo::cargo;
use crate::end::End;
use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Beginnings of the names of variables that cargo sets for what it runs.
const SET_BY_CARGO: [&str; 2] = ["CARGO_MANIFEST_", "CARGO_PKG_"];

/// Tests library and program with Zenoh, checks the types of the cases, and runs them. Returns what they print. Not run
/// if the user may make no machines.
pub fn campaign(log: &Path) -> End<Vec<String>> {
    if !install::is_root() {
        return Err("only root may make network namespaces".into());
    }
    install::machines()?;
    install::python3("python3")?;
    let folder = paths::target().join("xtask/zenoh");
    let python = install::python_in("python3", &folder, &cases().join("requirements.txt"))?;
    Ok(tested(log).and_then(|programs| run(&python, &programs, log)))
}

/// Runs the tests with Zenoh; returns the program that they are of, and the one that keeps what a board sends.
fn tested(log: &Path) -> Result<[PathBuf; 2], String> {
    let of = ["--package", "taxel", "--package", "taxel-cli", "--package", "taxel-bench"];
    let of = [&of[..], &["--features", "full,zenoh"]].concat();
    for what in [&["test", "--test", "zenoh"][..], &["build", "--bin", "taxel-bench"]] {
        let mut cargo = cargo(&[what, &of].concat(), paths::root());
        // What cargo sets for this program: `ring` would be built anew for it, and all that is above.
        let set_by_cargo = std::env::vars_os().map(|(name, _)| name);
        let set_by_cargo = set_by_cargo.filter(|name| {
            name.to_str().is_some_and(|name| SET_BY_CARGO.iter().any(|t| name.starts_with(t)))
        });
        set_by_cargo.for_each(|name| _ = cargo.env_remove(name));
        process::run_into(&mut cargo, log)?;
    }
    Ok(["taxel", "taxel-bench"].map(|name| paths::target().join("debug").join(name)))
}

fn run(python: &Path, programs: &[PathBuf; 2], log: &Path) -> Result<Vec<String>, String> {
    let mut mypy = Command::new(python);
    mypy.args(["-m", "mypy", "--strict", "--cache-dir"]).arg(paths::target().join("xtask/mypy"));
    process::run_into(mypy.arg(".").current_dir(cases()), log)?;
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    process::run_into(Command::new(python).arg(cases().join("campaign.py")).args(programs), log)?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    Ok(said.get(before..).unwrap_or_default().lines().map(String::from).collect())
}

/// The cases.
fn cases() -> PathBuf {
    paths::root().join("tests/zenoh")
}
