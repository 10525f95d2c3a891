//! Test targets that a plain `cargo test` leaves out: they need the firmware image, recordings, Python, or
//! failing system calls.

use crate::cargo::{WHOLE, cargo};
use crate::cross::Toolchain;
use crate::end::{End, shown};
use crate::{firmware, install, paths, process, recordings};
use std::path::Path;
use std::process::Command;

/// These targets by package; cargo skips them even if all targets are selected.
pub const APART: &[(&str, &[&str])] = &[
    ("taxel-tests", &["emulated", "cycles"]),
    ("taxel-cli", &["recorded", "python", "disk"]),
    ("taxel-learn", &["trained"]),
];

/// Default minutes of a soak.
const SOAK_MINUTES: f64 = 20.0;

/// Runs one module of the tests on the emulated board, and prints its measurements.
pub fn on_emulator(module: &'static str, log: &Path) -> End {
    shown(measured(module, log, &[])?)
}

/// Output of one module of the tests on the emulated board.
pub fn measured(module: &str, log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    install::emulator()?;
    let toolchain = Toolchain::find()?;
    let image = match firmware::image(&toolchain, log) {
        Ok(image) => image,
        Err(why) => return Ok(Err(why)),
    };
    let elf = image.elf.to_string_lossy().into_owned();
    let own = [("TAXEL_FIRMWARE_ELF", elf.as_str()), ("TAXEL_LIBRARY", toolchain.library())];
    let variables = [variables, &own].concat();
    Ok(printed("emulated", &[&format!("{module}::")], log, &variables))
}

/// Output of a test target, or of those of its tests whose names contain one of `names`.
pub fn printed(
    target: &str,
    names: &[&str],
    log: &Path,
    variables: &[(&str, &str)],
) -> Result<Vec<String>, String> {
    let mut command = test_target(target);
    said(command.envs(variables.iter().copied()), names, log)
}

/// What the tests of a cargo command print.
fn said(command: &mut Command, names: &[&str], log: &Path) -> Result<Vec<String>, String> {
    let end = process::run_into(command.args(["--", "--nocapture"]).args(names), log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let lines = text.lines().skip_while(|line| !line.starts_with("running ")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with("test result"));
    let lines = lines.filter(|line| !line.starts_with("test ")).map(String::from).collect();
    end.map(|()| lines)
}

/// Compares the cost of the chain on the emulated board with the limits and with the table.
pub fn cycles(log: &Path) -> End {
    install::emulator()?;
    let toolchain = Toolchain::find()?;
    if let Err(why) = process::run_into(firmware::bench_command(&toolchain).arg("--locked"), log) {
        return Ok(Err(why));
    }
    Ok(process::run_into(measuring(&toolchain)?.arg("--check"), log))
}

/// `cargo xtask cycles`: table of the chain's cost on the emulated board.
pub fn show_cycles(args: &[String]) -> Result<(), String> {
    install::emulator()?;
    let toolchain = Toolchain::find()?;
    process::run(&mut firmware::bench_command(&toolchain))?;
    process::run(measuring(&toolchain)?.args(args))
}

/// The measuring program, without its own options.
pub fn measuring(toolchain: &Toolchain) -> Result<Command, String> {
    let mut command = test_target("cycles");
    let image = firmware::bench_elf(toolchain);
    command.env("TAXEL_COMPILER", firmware::compiler(&image, toolchain)?);
    command.arg("--").env("TAXEL_BENCH_ELF", image);
    Ok(command)
}

/// Checks files and lines of the program with Python, and prints the measurements.
pub fn python(log: &Path) -> End {
    shown(read_by_python(&[], log, &[])?)
}

/// Output of the Python tests.
pub fn read_by_python(names: &[&str], log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let python = install::python()?.to_string_lossy().into_owned();
    let variables = [variables, &[("TAXEL_PYTHON", python.as_str())]].concat();
    Ok(printed("python", names, log, &variables))
}

/// Runs every command that writes on a failing disk, and prints what was tried.
pub fn disk(log: &Path) -> End {
    shown(on_failing_disk(log, &[])?)
}

/// Output of the tests on a failing disk.
pub fn on_failing_disk(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    if !cfg!(all(target_os = "linux", target_env = "gnu")) {
        return Err("a program's calls are made to fail on Linux with glibc alone".into());
    }
    let mut build = cargo(&["build", "--package", "taxel-disk"], paths::root());
    process::run_into(&mut build, log).map_err(|why| format!("what makes calls fail is not built: {why}"))?;
    let library = paths::target().join("debug/libtaxel_disk.so").to_string_lossy().into_owned();
    Ok(printed("disk", &[], log, &[variables, &[("TAXEL_DISK", library.as_str())]].concat()))
}

/// `cargo xtask soak`: runs failing boards for minutes while they are recorded, watched and reconfigured.
pub fn soak(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let minutes = match args[..] {
        [] => SOAK_MINUTES,
        ["--minutes", minutes] => minutes
            .parse()
            .ok()
            .filter(|minutes| (0.1..1e5).contains(minutes))
            .ok_or("--minutes takes a number above 0.1")?,
        _ => return Err(crate::USAGE.into()),
    };
    let mut command = test_target("commands");
    command.args(["--", "--nocapture", "session::soak::"]).env("TAXEL_SOAK_MINUTES", minutes.to_string());
    process::run(&mut command)
}

/// Runs recordings through the pipeline.
pub fn recorded(log: &Path) -> End {
    recordings::at_hand()?;
    Ok(process::run_into(&mut test_target("recorded"), log))
}

/// Trains models on recorded touches with people and days left out.
pub fn trained(log: &Path) -> End {
    recordings::at_hand()?;
    Ok(process::run_into(&mut test_target("trained"), log))
}

/// Runs recordings on the emulated board and on this machine.
pub fn emulator_recorded(log: &Path) -> End {
    recordings::at_hand()?;
    on_emulator("recorded", log)
}

/// `cargo xtask recorded`: runs the recordings through the pipeline, with output.
pub fn feed_recordings(args: &[String]) -> Result<(), String> {
    recordings::at_hand()?;
    let mut command = test_target("recorded");
    command.args(["--", "--nocapture", "frames::"]);
    match args {
        [] => {}
        [all] if all == "--all" => _ = command.env("TAXEL_RECORDED", "all"),
        _ => return Err(crate::USAGE.into()),
    }
    process::run(&mut command)
}

/// `cargo xtask peers`: times the core beside other libraries, in one run.
pub fn peers(args: &[String]) -> Result<(), String> {
    process::run(of_peers(&["bench", "--quiet", "--bench", "times", "--"]).args(args))
}

/// Tests that the core and imageproc find the same, after clippy; what the test prints.
pub fn equal_to_peers(log: &Path) -> Result<Vec<String>, String> {
    let clippy = ["clippy", "--all-targets", "--", "--deny", "warnings"];
    process::run_into(&mut of_peers(&clippy), log)?;
    said(&mut of_peers(&["test", "--test", "equal"]), &[], log)
}

/// Cargo in the package of the peers, with the target folder of all.
fn of_peers(args: &[&str]) -> Command {
    let mut command = cargo(args, paths::peers());
    command.env("CARGO_TARGET_DIR", paths::target());
    command
}

/// `cargo xtask bench`: cost and error on this machine.
pub fn bench(args: &[String]) -> Result<(), String> {
    let mut command =
        cargo(&["run", "--quiet", "--release", "--package", "taxel-bench", "--"], paths::root());
    process::run(command.args(args))
}

/// A test target of the workspace.
pub fn test_target(name: &str) -> Command {
    let mut command = cargo(&[&["test"], WHOLE, &["--test", name]].concat(), paths::root());
    match recordings::listed() {
        Some(folders) => command.env(recordings::VARIABLE, folders),
        None => command.env_remove(recordings::VARIABLE),
    };
    command
}
