//! The test targets that a plain `cargo test` leaves out: they need the firmware image, or the recordings, or both.

use crate::checks::{cargo, image};
use crate::cross::Toolchain;
use crate::{elf, firmware, install, paths, process};
use std::path::Path;
use std::process::Command;

/// All of them; cargo passes them over even where it is asked for all targets.
pub const APART: &[&str] = &[
    "emulator",
    "emulator_stack",
    "emulator_scan",
    "emulator_usb",
    "emulator_latency",
    "emulator_store",
    "emulator_health",
    "emulator_recorded",
    "record_python",
    "recorded",
    "touch_recorded",
    "cycles",
];

/// Five contacts at full speed.
pub fn emulator(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator", log)
}

/// How deep the stack gets.
pub fn emulator_stack(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_stack", log)
}

/// The scan by DMA and PIO, every code checked.
pub fn emulator_scan(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_scan", log)
}

/// The board on USB: what arrives, and what it costs.
pub fn emulator_usb(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_usb", log)
}

/// How late messages and reactions are.
pub fn emulator_latency(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_latency", log)
}

/// Settings in the flash.
pub fn emulator_store(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_store", log)
}

/// Faults of lines, inputs and taxels.
pub fn emulator_health(log: &Path) -> Result<Result<(), String>, String> {
    on_emulator("emulator_health", log)
}

/// Recordings on the emulated board and on this machine.
pub fn emulator_recorded(log: &Path) -> Result<Result<(), String>, String> {
    recordings()?;
    on_emulator("emulator_recorded", log)
}

/// A test target that runs the firmware image; what it measured is shown.
fn on_emulator(target: &str, log: &Path) -> Result<Result<(), String>, String> {
    let end = measured(target, log, &[])?;
    Ok(end.map(|lines| lines.iter().for_each(|line| println!("  {line}"))))
}

/// What a test target that runs the firmware image printed.
pub fn measured(
    target: &str,
    log: &Path,
    variables: &[(&str, &str)],
) -> Result<Result<Vec<String>, String>, String> {
    install::emulator()?;
    let image = match image(&Toolchain::find()?, log) {
        Ok(image) => image,
        Err(why) => return Ok(Err(why)),
    };
    let elf = image.elf.to_string_lossy().into_owned();
    let variables = [variables, &[("TAXEL_FIRMWARE_ELF", elf.as_str())]].concat();
    Ok(printed(target, log, &variables))
}

/// What a test target printed.
pub fn printed(target: &str, log: &Path, variables: &[(&str, &str)]) -> Result<Vec<String>, String> {
    let mut command = test_target(target);
    command.args(["--", "--nocapture"]).envs(variables.iter().copied());
    let end = process::run_into(&mut command, log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let lines = text.lines().skip_while(|line| !line.starts_with("running ")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with("test result")).map(String::from).collect();
    end.map(|()| lines)
}

/// What the chain costs on the emulated board, against the bars and the table that was written.
pub fn cycles(log: &Path) -> Result<Result<(), String>, String> {
    install::emulator()?;
    let mut build = firmware::bench_command(&Toolchain::find()?);
    if let Err(why) = process::run_into(build.arg("--locked"), log) {
        return Ok(Err(why));
    }
    Ok(process::run_into(measuring().arg("--check"), log))
}

/// `cargo xtask cycles`: the table of what the chain costs on the emulated board.
pub fn show_cycles(args: &[String]) -> Result<(), String> {
    install::emulator()?;
    process::run(&mut firmware::bench_command(&Toolchain::find()?))?;
    process::run(measuring().args(args))
}

/// The program that measures, up to its own options.
fn measuring() -> Command {
    let mut command = test_target("cycles");
    let image = firmware::bench_elf();
    if let Some(compiler) = std::fs::read(&image).ok().as_deref().and_then(elf::compiler) {
        command.env("TAXEL_COMPILER", compiler);
    }
    command.arg("--").env("TAXEL_BENCH_ELF", image);
    command
}

/// Recordings as Python's readers find them; what was measured is shown.
pub fn record_python(log: &Path) -> Result<Result<(), String>, String> {
    let end = read_by_python(log, &[])?;
    Ok(end.map(|lines| lines.iter().filter(|line| !line.is_empty()).for_each(|line| println!("  {line}"))))
}

/// What the readers of Python found.
pub fn read_by_python(log: &Path, variables: &[(&str, &str)]) -> Result<Result<Vec<String>, String>, String> {
    let python = install::python()?;
    if let Err(why) = process::run_into(&mut cargo(&["build", "--package", "taxel"], paths::root()), log) {
        return Ok(Err(why));
    }
    let program = paths::target().join("debug/taxel").with_extension(std::env::consts::EXE_EXTENSION);
    let [python, program] = [python, program].map(|path| path.to_string_lossy().into_owned());
    let given = [("TAXEL_PYTHON", python.as_str()), ("TAXEL_PROGRAM", program.as_str())];
    Ok(printed("record_python", log, &[variables, given.as_slice()].concat()))
}

/// Recordings through the pipeline.
pub fn recorded(log: &Path) -> Result<Result<(), String>, String> {
    recordings()?;
    Ok(process::run_into(&mut test_target("recorded"), log))
}

/// Recorded touches, recognised with people and days kept apart.
pub fn touch_recorded(log: &Path) -> Result<Result<(), String>, String> {
    recordings()?;
    Ok(process::run_into(&mut test_target("touch_recorded"), log))
}

/// `cargo xtask recorded`: the recordings through the pipeline, in the open.
pub fn feed_recordings(args: &[String]) -> Result<(), String> {
    recordings()?;
    let mut command = test_target("recorded");
    command.args(["--", "--nocapture"]);
    match args {
        [] => {}
        [all] if all == "--all" => _ = command.env("TAXEL_RECORDED", "all"),
        _ => return Err(crate::USAGE.into()),
    }
    process::run(&mut command)
}

/// `cargo xtask peers`: the core beside other libraries, in one run.
pub fn peers(args: &[String]) -> Result<(), String> {
    let mut command =
        cargo(&["bench", "--quiet", "--package", "taxel-tests", "--bench", "peers", "--"], paths::root());
    process::run(command.args(args))
}

/// One of the test targets that a plain `cargo test` leaves out.
fn test_target(name: &str) -> Command {
    let mut command = cargo(&["test", "--package", "taxel-tests", "--test", name], paths::root());
    command.env("TAXEL_DATA", paths::recorded_data());
    command
}

/// Whether the recordings are there.
fn recordings() -> Result<(), String> {
    let data = paths::recorded_data();
    if data.is_dir() {
        return Ok(());
    }
    Err(format!("no recorded data in {} (TAXEL_DATA names another folder)", data.display()))
}
