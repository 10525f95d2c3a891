//! `cargo xtask package`: the crates that others can depend on. Builds each from its package alone, and all
//! with the oldest dependencies that the manifests allow; compares their interfaces with the last release.

use crate::cargo::{WHOLE, cargo};
use crate::end::End;
use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The published crates, in the order in which they depend on each other.
const PUBLISHED: [&str; 5] = ["taxel-core", "taxel-store", "taxel-sim", "taxel", "taxel-cli"];

/// Packs them; changes that are not committed are packed, too.
fn packing() -> Command {
    let mut command = cargo(&["package", "--quiet", "--allow-dirty"], paths::root());
    command.args(PUBLISHED.iter().flat_map(|name| ["--package", *name]));
    command
}

/// Packs them and builds each from its package; then the other two. What could not run is an error.
pub fn run() -> Result<(), String> {
    lint_defaults()?;
    process::run(&mut packing())?;
    build_with_oldest()?;
    compare_with_last()
}

/// Lints them with their default features; the check uses all of them.
fn lint_defaults() -> Result<(), String> {
    let packages: Vec<&str> = PUBLISHED.iter().flat_map(|name| ["--package", *name]).collect();
    process::run(&mut cargo(
        &[&["clippy"], &packages[..], &["--", "--deny", "warnings"]].concat(),
        paths::root(),
    ))
}

/// Builds the last commit with the oldest version of each direct dependency.
fn build_with_oldest() -> Result<(), String> {
    install::nightly()?;
    let copy = copy_of("HEAD", "oldest")?;
    let resolve = ["run", "nightly", "cargo", "update", "--quiet", "-Zdirect-minimal-versions"];
    process::run(Command::new("rustup").args(resolve).current_dir(&copy))?;
    process::run(&mut cargo(&[&["check", "--quiet"], WHOLE].concat(), copy))
}

/// Compares the interfaces of the last commit with those of the last tag: what the version does not allow to
/// change is an error.
fn compare_with_last() -> Result<(), String> {
    let tag = ["describe", "--tags", "--abbrev=0", "--match=v*"];
    let tag = process::output(Command::new("git").args(tag).current_dir(paths::root()))
        .ok_or("interfaces: not run: there is no tag of a release (v0.2.0) to compare with")?;
    let tool =
        install::cargo_tool("cargo-semver-checks", "0.51.0").map_err(|why| format!("not run: {why}"))?;
    let (now, then) = (copy_of("HEAD", "interfaces")?, copy_of(tag.trim(), "interfaces-before")?);
    for copy in [&now, &then] {
        // It looks for a crate's workspace in the folders above, and takes that of the firmware for the store's.
        let manifest = copy.join("firmware/Cargo.toml");
        std::fs::remove_file(&manifest).map_err(|error| format!("{}: {error}", manifest.display()))?;
    }
    let mut command = Command::new(tool);
    command.arg("semver-checks").arg("--manifest-path").arg(now.join("Cargo.toml"));
    command.arg("--baseline-root").arg(then);
    command.args(PUBLISHED.iter().flat_map(|name| ["--package", *name]));
    process::run(&mut command)
}

/// Copies a revision into a folder of its own.
fn copy_of(revision: &str, name: &str) -> Result<PathBuf, String> {
    let (copy, index) = (paths::target().join(name), paths::target().join(format!("{name}.index")));
    // What an earlier copy had more would be built, too.
    let _ = std::fs::remove_dir_all(&copy);
    let git = |args: &[&str]| {
        process::run(Command::new("git").args(args).current_dir(paths::root()).env("GIT_INDEX_FILE", &index))
    };
    git(&["read-tree", revision])?;
    git(&["checkout-index", "--all", "--force", &format!("--prefix={}/", copy.display())])?;
    Ok(copy)
}

/// Packs them only: a file, a version or a description that is missing is found in a second.
pub fn check(log: &Path) -> End {
    Ok(process::run_into(packing().arg("--no-verify"), log))
}
