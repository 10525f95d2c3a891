//! `cargo xtask campaign`: runs that take longer than a check may, each of which prints a table.

use crate::{browser, paths, targets};
use std::fmt::Write;
use std::path::PathBuf;

/// What a run needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Needs {
    Nothing,
    /// The firmware image.
    Image,
    /// A browser.
    Browser,
    /// Python's readers of recordings.
    Python,
}

/// The runs: a test target, what it needs, and what of it takes longer where TAXEL_CAMPAIGN is set.
const RUNS: [(&str, Needs, &str); 8] = [
    ("emulator_usb", Needs::Image, "frames over USB: every scene of the bench, 400 scans each (emulated)"),
    ("emulator_latency", Needs::Image, "onset and reflex: 500 touches of one to five contacts (emulated)"),
    ("emulator_health", Needs::Image, "health: 1,000 healthy frames, then one of each fault (emulated)"),
    ("health", Needs::Nothing, "health: every fault, and 10,000 healthy frames (simulated)"),
    ("setup", Needs::Nothing, "setup by touch: 1,000 random wirings (simulated)"),
    ("people", Needs::Nothing, "intentions: 4,000 touches by 20 people, of each of two families (simulated)"),
    ("record_python", Needs::Python, "recordings: kill -9 while 50 of them are made"),
    ("stream.test.mjs", Needs::Browser, "taxel view: ten minutes of five contacts at full speed (simulated)"),
];

/// Runs all of them; `--write`: and writes what they print.
pub fn run(args: &[String]) -> Result<(), String> {
    let write = match args {
        [] => false,
        [write] if write == "--write" => true,
        _ => return Err(crate::USAGE.into()),
    };
    let logs = paths::target().join("xtask");
    std::fs::create_dir_all(&logs).map_err(|error| format!("{}: {error}", logs.display()))?;
    let mut table = String::from(
        "Long runs on the emulated and the simulated board; `cargo xtask campaign --write` writes this.\n",
    );
    for (target, needs, what) in RUNS {
        println!("{what} ...");
        let log = logs.join(format!("campaign-{target}.log"));
        let _ = std::fs::remove_file(&log);
        let longer = [("TAXEL_CAMPAIGN", "1")];
        let end = match needs {
            Needs::Image => targets::measured(target, &log, &longer)?,
            Needs::Nothing => targets::printed(target, &log, &longer),
            Needs::Browser => browser::measured(&[target], &log, &longer)?,
            Needs::Python => targets::read_by_python(&log, &longer)?,
        };
        let lines = end.map_err(|why| format!("{target}: {why}, see {}", log.display()))?;
        let said = lines.iter().filter(|line| !line.starts_with("test ") && !line.is_empty());
        // A string takes all.
        let _ = writeln!(table, "\n{what}");
        said.for_each(|line| _ = writeln!(table, "  {line}"));
    }
    print!("{table}");
    if write {
        std::fs::write(written(), table).map_err(|error| format!("{}: {error}", written().display()))
    } else {
        Ok(())
    }
}

fn written() -> PathBuf {
    paths::root().join("docs/bench/campaign.txt")
}
