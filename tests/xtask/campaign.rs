//! `cargo xtask campaign`: runs that take longer than a check may, each of which prints a table.

use crate::{browser, paths, targets};
use std::path::{Path, PathBuf};

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

/// What the table begins with.
const TITLE: &str =
    "Long runs on the emulated and the simulated board; `cargo xtask campaign --write` writes this.";

/// Runs all of them, or `--only` one; `--write`: and writes what they print.
pub fn run(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let (only, write) = match args[..] {
        [] => (None, false),
        ["--write"] => (None, true),
        ["--only", name] => (Some(name), false),
        ["--only", name, "--write"] => (Some(name), true),
        _ => return Err(crate::USAGE.into()),
    };
    let chosen: Vec<_> = RUNS.iter().filter(|(target, ..)| only.is_none_or(|only| only == *target)).collect();
    if chosen.is_empty() {
        return Err(format!(
            "there is no such run; there are {}",
            RUNS.map(|(target, ..)| target).join(", ")
        ));
    }
    let logs = paths::target().join("xtask");
    std::fs::create_dir_all(&logs).map_err(|error| format!("{}: {error}", logs.display()))?;
    for (target, needs, what) in chosen {
        println!("{what} ...");
        let lines = measured(target, *needs, &logs.join(format!("campaign-{target}.log")))?;
        println!("{lines}");
        if write {
            note(what, &lines).map_err(|error| format!("{}: {error}", written().display()))?;
        }
    }
    Ok(())
}

/// What one of them prints.
fn measured(target: &'static str, needs: Needs, log: &Path) -> Result<String, String> {
    let _ = std::fs::remove_file(log);
    let longer = [("TAXEL_CAMPAIGN", "1")];
    let end = match needs {
        Needs::Image => targets::measured(target, log, &longer)?,
        Needs::Nothing => targets::printed(target, log, &longer),
        Needs::Browser => browser::measured(&[target], log, &longer)?,
        Needs::Python => targets::read_by_python(log, &longer)?,
    };
    let lines = end.map_err(|why| format!("{target}: {why}, see {}", log.display()))?;
    // Nor does it belong into a table which files were written.
    let file = paths::target().display().to_string();
    let said = lines.iter().filter(|line| {
        !line.is_empty() && !["test ", file.as_str()].iter().any(|other| line.starts_with(other))
    });
    Ok(said.map(|line| format!("  {line}")).collect::<Vec<_>>().join("\n"))
}

/// Puts what a run printed in the place of what it printed before.
fn note(what: &str, lines: &str) -> std::io::Result<()> {
    let before = std::fs::read_to_string(written())?;
    let mut table = TITLE.to_string();
    for (_, _, of) in RUNS {
        let kept =
            before.split("\n\n").find_map(|section| section.trim_end().strip_prefix(of)?.strip_prefix('\n'));
        let lines = if of == what { Some(lines) } else { kept };
        let Some(lines) = lines else { continue };
        table += &format!("\n\n{of}\n{lines}");
    }
    std::fs::write(written(), table + "\n")
}

fn written() -> PathBuf {
    paths::root().join("docs/bench/campaign.txt")
}
