//! `cargo xtask test`: all checks, three at a time: those that compile in the same folder wait for cargo, and
//! the emulator takes one core.

use crate::cargo::{WHOLE, cargo};
use crate::counts::Counts;
use crate::cross::Toolchain;
use crate::end::End;
use crate::excerpt::excerpt;
use crate::report::{Outcome, Report};
use crate::{
    browser, features, firmware, locks, no_panic, package, paths, process, python, recordings, ros2, sizes,
    targets, workflows,
};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Instant;

/// A check. It appends its output to a log.
type Check = fn(&Path) -> End;

/// Checks in starting order: first those that compile or install something, at last the many that only run, so
/// that no core idles at the end.
const CHECKS: &[(&str, Check)] = &[
    ("fmt", fmt),
    ("test", test),
    ("firmware", build_firmware),
    ("no-panic", no_panic::check),
    ("firmware-clippy", firmware_clippy),
    ("features", features::check),
    ("ros2", ros2::check),
    ("wheel", python::check),
    ("python", targets::python),
    ("clippy", clippy),
    ("docs", docs),
    ("view", browser::check),
    ("disk", targets::disk),
    ("cycles", targets::cycles),
    ("emulator-scan", |log| targets::on_emulator("scan", log)),
    ("emulator-usb", |log| targets::on_emulator("usb", log)),
    ("emulator-surface", |log| targets::on_emulator("surface", log)),
    ("emulator-boots", |log| targets::on_emulator("boots", log)),
    ("emulator-latency", |log| targets::on_emulator("latency", log)),
    ("emulator-mishaps", |log| targets::on_emulator("mishaps", log)),
    ("emulator", |log| targets::on_emulator("contacts", log)),
    ("emulator-outputs", |log| targets::on_emulator("outputs", log)),
    ("emulator-health", |log| targets::on_emulator("health", log)),
    ("emulator-stack", |log| targets::on_emulator("stack", log)),
    ("emulator-store", |log| targets::on_emulator("store", log)),
    ("emulator-units", emulator_units),
    ("package", package::check),
    ("locks", compare_locks),
    ("workflows", workflows::check),
];

/// Checks that need recordings, which only their owners have; they run on request.
const RECORDED: &[(&str, Check)] = &[
    ("recorded", targets::recorded),
    ("trained", targets::trained),
    ("emulator-recorded", targets::emulator_recorded),
];

/// Checks at a time.
const AT_ONCE: usize = 3;

/// Options of the command line.
struct Asked {
    checks: Vec<(&'static str, Check)>,
    may_miss: Vec<String>,
    /// True if the checks that need recordings were not requested.
    left_out: bool,
}

impl Asked {
    fn read(args: &[String]) -> Result<Asked, String> {
        let (mut only, mut may_miss) = (Vec::new(), Vec::new());
        let mut recorded = recordings::listed().is_some();
        let all = || CHECKS.iter().chain(RECORDED);
        let mut args = args.iter();
        while let Some(arg) = args.next() {
            let list = match arg.as_str() {
                "--recorded" => {
                    recorded = true;
                    continue;
                }
                "--only" => &mut only,
                "--may-miss" => &mut may_miss,
                _ => return Err(format!("unknown option {arg}\n{}", crate::USAGE)),
            };
            let name = args.next().filter(|name| all().any(|(known, _)| known == name));
            let names = || all().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            list.push(name.ok_or_else(|| format!("{arg} takes one of: {}", names()))?.clone());
        }
        let extra = if recorded { RECORDED } else { &[] };
        let checks: Vec<_> = if only.is_empty() {
            CHECKS.iter().chain(extra).copied().collect()
        } else {
            all().filter(|(name, _)| only.iter().any(|only| only == name)).copied().collect()
        };
        Ok(Asked { checks, may_miss, left_out: only.is_empty() && !recorded })
    }
}

/// Runs the selected checks. Returns true if all is well.
pub fn run(args: &[String]) -> Result<bool, String> {
    let asked = Asked::read(args)?;
    let logs = paths::target().join("xtask");
    std::fs::create_dir_all(&logs).map_err(|error| format!("{}: {error}", logs.display()))?;
    let start = Instant::now();
    let report = Mutex::new(Report::default());
    let waiting = Mutex::new(asked.checks.into_iter());
    let work = || {
        while let Some((name, check)) = next(&waiting) {
            let outcome = one(name, check, &logs.join(format!("{name}.log")));
            report.lock().unwrap_or_else(|broken| broken.into_inner()).add(name, outcome);
        }
    };
    std::thread::scope(|scope| (0..AT_ONCE).for_each(|_| _ = scope.spawn(work)));
    let report = report.into_inner().unwrap_or_else(|broken| broken.into_inner());
    if asked.left_out {
        let names: Vec<&str> = RECORDED.iter().map(|(name, _)| *name).collect();
        println!("\nnot asked for: {}, which need recordings (--recorded)", names.join(", "));
    }
    println!("\n{} min\n{}", start.elapsed().as_secs().div_ceil(60), report.closing());
    Ok(report.succeeded(&asked.may_miss))
}

fn next(waiting: &Mutex<impl Iterator<Item = (&'static str, Check)>>) -> Option<(&'static str, Check)> {
    waiting.lock().unwrap_or_else(|broken| broken.into_inner()).next()
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
            println!("{}\n{name}: FAILED in {seconds:.1} s: {why}", excerpt(&text));
            println!("all that it said: {}", log.display());
            Outcome::Failed(counts.unwrap_or_default(), why)
        }
        Err(why) => {
            println!("{name}: not run: {why}");
            Outcome::NotRun(why)
        }
    }
}

fn fmt(log: &Path) -> End {
    let check = |folder| {
        process::run_into(&mut cargo(&["fmt", "--all", "--", "--check", "--color=never"], folder), log)
    };
    let apart = paths::apart().map(|(_, folder)| folder);
    Ok([paths::root()].into_iter().chain(apart).try_for_each(check))
}

fn clippy(log: &Path) -> End {
    let run = |which: &[&str]| {
        let args = [&["clippy"], which, &["--", "--deny", "warnings"]].concat();
        process::run_into(&mut cargo(&args, paths::root()), log)
    };
    let apart: Vec<&str> = targets::APART
        .iter()
        .flat_map(|(_, names)| names.iter().flat_map(|name| ["--test", *name]))
        .collect();
    // The unit tests of a core without features are those of the core.
    let whole = [WHOLE, &["--exclude", "taxel-core-featureless", "--all-targets"]].concat();
    Ok(run(&whole).and_then(|()| run(&[WHOLE, &apart].concat())))
}

fn compare_locks(log: &Path) -> End {
    let read = |path: PathBuf| {
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let root = read(paths::root().join("Cargo.lock"));
    let compare = |root: &str, (name, folder): (&str, PathBuf)| {
        locks::compare(root, &read(folder.join("Cargo.lock"))?, name)
    };
    // What is built with `--locked` must not want a newer lock file than the one that is checked in.
    let complete = |(_, folder): (&str, PathBuf)| {
        process::run_into(&mut cargo(&["update", "--workspace", "--locked", "--offline"], folder), log)
    };
    Ok(root
        .and_then(|root| paths::apart().into_iter().try_for_each(|apart| compare(&root, apart)))
        .and_then(|()| paths::apart().into_iter().try_for_each(complete)))
}

fn test(log: &Path) -> End {
    let all = [&["test"], WHOLE, &["--no-fail-fast"]].concat();
    Ok(process::run_into(&mut cargo(&all, paths::root()), log))
}

fn docs(log: &Path) -> End {
    let mut command = cargo(&[&["doc"], WHOLE, &["--no-deps"]].concat(), paths::root());
    Ok(process::run_into(command.env("RUSTDOCFLAGS", "--deny warnings"), log))
}

/// The image, and its sizes beside the table.
fn build_firmware(log: &Path) -> End {
    let image = firmware::image(&Toolchain::find()?, log);
    Ok(image.and_then(|image| {
        print!("{image}");
        sizes::check(&image).map(|beside| print!("{beside}"))
    }))
}

fn firmware_clippy(log: &Path) -> End {
    let toolchain = Toolchain::find()?;
    toolchain.install_clippy()?;
    let mut command = toolchain.cargo("clippy", &paths::firmware());
    Ok(process::run_into(
        command.args(["--bins", "--examples", "--features", "bench", "--", "--deny", "warnings"]),
        log,
    ))
}

fn emulator_units(log: &Path) -> End {
    crate::install::emulator()?;
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=tap"]).current_dir(paths::emulator());
    Ok(process::run_into(&mut node, log))
}
