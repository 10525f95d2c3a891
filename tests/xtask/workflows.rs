//! The check `workflows`: what GitHub runs is judged by programs of others, and so are the scripts of a release.

use crate::end::End;
use crate::{install, interpreter, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest CPython for which all of them are there.
const OLDEST: u32 = 11;

/// Runs them, without asking the network.
pub fn check(log: &Path) -> End {
    let judges = judges()?;
    let [check, release, site] =
        ["check", "release", "site"].map(|name| format!(".github/workflows/{name}.yml"));
    let judged: [(&str, &[&str]); 4] = [
        ("zizmor", &["--offline", &check, &release, &site]),
        ("check-jsonschema", &["--builtin-schema", "vendor.github-workflows", &check, &release, &site]),
        ("mypy", &["--strict", "--cache-dir", "target/xtask/mypy", "tests/release"]),
        ("python", &["-m", "unittest", "discover", "--start-directory", "tests/release"]),
    ];
    Ok(judged.into_iter().try_for_each(|(judge, words)| {
        process::run_into(Command::new(judges.join(judge)).args(words).current_dir(paths::root()), log)
    }))
}

/// The environment of the judges; the folder of its programs.
pub fn judges() -> Result<PathBuf, String> {
    let mut newest = (OLDEST..=*interpreter::VERSIONS.end()).rev();
    let python = newest.find_map(interpreter::interpreter);
    let python = python.ok_or(format!("there is no python3.{OLDEST} or later"))?;
    let wanted = paths::root().join("tests/release/judges.txt");
    let python = install::python_in(&python, &paths::target().join("xtask/judges"), &wanted)?;
    Ok(python.with_file_name(""))
}
