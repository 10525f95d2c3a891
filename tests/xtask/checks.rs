//! `cargo xtask test`: every check, one after the other.

use crate::counts::Counts;
use crate::cross::Toolchain;
use crate::report::{Outcome, Report};
use crate::{browser, firmware, install, locks, no_panic, paths, process, sizes, targets};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// A check appends what it prints to a log. `Err` of the outer result: it cannot run, and why.
type Check = fn(&Path) -> Result<Result<(), String>, String>;

const CHECKS: &[(&str, Check)] = &[
    ("fmt", fmt),
    ("clippy", clippy),
    ("locks", compare_locks),
    ("test", test),
    ("docs", docs),
    ("core-thumb", core_thumb),
    ("firmware", build_firmware),
    ("sizes", compare_sizes),
    ("firmware-clippy", firmware_clippy),
    ("no-panic", no_panic::check),
    ("emulator-units", emulator_units),
    ("view", browser::check),
    ("cycles", targets::cycles),
    ("emulator", targets::emulator),
    ("emulator-stack", targets::emulator_stack),
    ("emulator-scan", targets::emulator_scan),
    ("emulator-usb", targets::emulator_usb),
    ("emulator-latency", targets::emulator_latency),
    ("emulator-store", targets::emulator_store),
    ("emulator-health", targets::emulator_health),
    ("record-python", targets::record_python),
    ("recorded", targets::recorded),
    ("touch-recorded", targets::touch_recorded),
    ("emulator-recorded", targets::emulator_recorded),
];

/// Lines of a failed check's log that are shown.
const SHOWN: usize = 80;

/// Runs the checks that `args` ask for. True: all is well.
pub fn run(args: &[String]) -> Result<bool, String> {
    let (mut only, mut may_miss) = (Vec::new(), Vec::new());
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let list = match arg.as_str() {
            "--only" => &mut only,
            "--may-miss" => &mut may_miss,
            _ => return Err(format!("unknown option {arg}\n{}", crate::USAGE)),
        };
        let name = args.next().filter(|name| CHECKS.iter().any(|(known, _)| known == name));
        list.push(name.ok_or_else(|| format!("{arg} takes one of: {}", names()))?.clone());
    }
    let logs = paths::target().join("xtask");
    std::fs::create_dir_all(&logs).map_err(|error| format!("{}: {error}", logs.display()))?;
    let mut report = Report::default();
    for (name, check) in CHECKS.iter().filter(|(name, _)| only.is_empty() || only.iter().any(|o| o == name)) {
        report.add(name, one(name, *check, &logs.join(format!("{name}.log"))));
    }
    println!("\n{}", report.closing());
    Ok(report.succeeded(&may_miss))
}

fn names() -> String {
    CHECKS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

fn one(name: &str, check: Check, log: &Path) -> Outcome {
    println!("{name} ...");
    let _ = std::fs::remove_file(log);
    let start = Instant::now();
    let end = check(log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let seconds = start.elapsed().as_secs_f64();
    let counts = Counts::of(&text);
    match end {
        Ok(Ok(())) if counts.is_some_and(|c| c.passed + c.failed == 0) => {
            println!("{name}: FAILED: it ran no test");
            Outcome::Failed(Counts::default(), "it ran no test".into())
        }
        Ok(Ok(())) => {
            let counts = counts.unwrap_or(Counts { passed: 1, failed: 0, skipped: 0 });
            println!("{name}: passed {} in {seconds:.1} s", counts.passed);
            Outcome::Passed(counts)
        }
        Ok(Err(why)) => {
            let lines: Vec<&str> = text.lines().collect();
            println!("{}", lines[lines.len().saturating_sub(SHOWN)..].join("\n"));
            println!("{name}: FAILED in {seconds:.1} s: {why}");
            Outcome::Failed(counts.unwrap_or_default(), why)
        }
        Err(why) => {
            println!("{name}: not run: {why}");
            Outcome::NotRun(why)
        }
    }
}

/// Cargo in a folder.
pub fn cargo(args: &[&str], folder: PathBuf) -> Command {
    let mut command = Command::new("cargo");
    command.args(args).current_dir(folder);
    command
}

fn fmt(log: &Path) -> Result<Result<(), String>, String> {
    let check = |folder| {
        process::run_into(&mut cargo(&["fmt", "--all", "--", "--check", "--color=never"], folder), log)
    };
    Ok(check(paths::root()).and_then(|()| check(paths::firmware())))
}

fn clippy(log: &Path) -> Result<Result<(), String>, String> {
    let run = |which: &[&str]| {
        let args = [&["clippy"], which, &["--", "--deny", "warnings"]].concat();
        process::run_into(&mut cargo(&args, paths::root()), log)
    };
    let apart: Vec<&str> = targets::APART.iter().flat_map(|name| ["--test", *name]).collect();
    let apart = [&["--package", "taxel-tests"], apart.as_slice()].concat();
    // The tests ask for all features of the program: as most build it, it is looked at for itself.
    let plain = ["--package", "taxel"];
    Ok(run(&["--workspace", "--all-targets"]).and_then(|()| run(&apart)).and_then(|()| run(&plain)))
}

fn compare_locks(_: &Path) -> Result<Result<(), String>, String> {
    let read = |path: PathBuf| {
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let root = read(paths::root().join("Cargo.lock"));
    let firmware = read(paths::firmware().join("Cargo.lock"));
    Ok(root.and_then(|root| locks::compare(&root, &firmware?)))
}

fn test(log: &Path) -> Result<Result<(), String>, String> {
    Ok(process::run_into(&mut cargo(&["test", "--workspace", "--no-fail-fast"], paths::root()), log))
}

fn docs(log: &Path) -> Result<Result<(), String>, String> {
    let mut command = cargo(&["doc", "--workspace", "--no-deps"], paths::root());
    Ok(process::run_into(command.env("RUSTDOCFLAGS", "--deny warnings"), log))
}

fn core_thumb(log: &Path) -> Result<Result<(), String>, String> {
    Ok(process::run_into(&mut firmware::core_command(&Toolchain::find()?), log))
}

fn build_firmware(log: &Path) -> Result<Result<(), String>, String> {
    Ok(image(&Toolchain::find()?, log).map(|image| print!("{image}")))
}

fn compare_sizes(log: &Path) -> Result<Result<(), String>, String> {
    Ok(image(&Toolchain::find()?, log).and_then(|image| sizes::check(&image.elf)))
}

/// The firmware as its lock file says; built at once where nothing has changed.
pub fn image(toolchain: &Toolchain, log: &Path) -> Result<firmware::Image, String> {
    process::run_into(firmware::command(toolchain).arg("--locked"), log).and_then(|()| firmware::measure())
}

fn firmware_clippy(log: &Path) -> Result<Result<(), String>, String> {
    let toolchain = Toolchain::find()?;
    if !toolchain.has_clippy() {
        install::packages(install::CROSS)?;
    }
    let mut command = toolchain.cargo("clippy", &paths::firmware());
    Ok(process::run_into(
        command.args(["--bins", "--examples", "--features", "bench", "--", "--deny", "warnings"]),
        log,
    ))
}

fn emulator_units(log: &Path) -> Result<Result<(), String>, String> {
    install::emulator()?;
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=tap"]).current_dir(paths::emulator());
    Ok(process::run_into(&mut node, log))
}
