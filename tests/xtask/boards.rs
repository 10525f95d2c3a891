//! `cargo xtask campaign --only boards`: what the program takes that records 100 boards with a view open.

use crate::cargo::cargo;
use crate::{paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Seconds for each number of boards, and at the end, instead of the campaign's: a short try beside other work.
const SECONDS: &str = "TAXEL_BOARDS_SECONDS";

/// Builds the program and the bench like a release, and returns what the bench prints.
pub fn campaign(log: &Path) -> Result<Vec<String>, String> {
    let build = ["build", "--release", "--package", "taxel-cli", "--package", "taxel-bench", "--bins"];
    process::run_into(&mut cargo(&build, paths::root()), log)?;
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    let mut bench = Command::new(paths::target().join("release/taxel-bench"));
    bench.args(["boards", "--force", "--svg"]).arg(chart());
    if let Ok(seconds) = std::env::var(SECONDS) {
        bench.args(["--seconds", &seconds, "--long", &seconds]);
    }
    process::run_into(&mut bench, log)?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    Ok(said.get(before..).unwrap_or_default().lines().map(String::from).collect())
}

/// Where the chart is drawn.
fn chart() -> PathBuf {
    paths::target().join("xtask/boards.svg")
}

/// Puts the chart beside the table.
pub fn keep_chart() -> Result<(), String> {
    let kept = paths::root().join("docs/evidence/bench/boards.svg");
    std::fs::copy(chart(), &kept).map(drop).map_err(|error| format!("{}: {error}", kept.display()))
}
