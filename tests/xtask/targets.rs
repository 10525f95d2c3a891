//! The test targets that a plain `cargo test` leaves out: they need the firmware image, recordings, Python, or
//! calls that fail.

use crate::checks::cargo;
use crate::cross::Toolchain;
use crate::{firmware, install, paths, process, recordings};
use std::path::Path;
use std::process::Command;

/// How a check ends. `Err` of the outer result: it cannot run, and why.
pub type End<T = ()> = Result<Result<T, String>, String>;

/// All of them by package; cargo passes them over even where it is asked for all targets.
pub const APART: &[(&str, &[&str])] =
    &[("taxel-tests", &["emulated", "cycles"]), ("taxel", &["recorded", "python", "disk"])];

/// Minutes of a soak where nobody says otherwise.
const SOAK_MINUTES: f64 = 20.0;

/// What all of the workspace's builds have in common, so that none builds anew what another has built: cargo
/// takes the features of dependencies from all packages and targets that it is asked for.
pub const WHOLE: &[&str] = &["--workspace", "--all-features"];

/// The part of the tests on the emulated board that a module holds; what it measured is shown.
pub fn on_emulator(module: &'static str, log: &Path) -> End {
    shown(measured(module, log, &[])?)
}

/// Lines of a check that are for people.
pub fn shown(end: Result<Vec<String>, String>) -> End {
    Ok(end.map(|lines| lines.iter().filter(|line| !line.is_empty()).for_each(|line| println!("  {line}"))))
}

/// What a module of the tests on the emulated board printed.
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

/// What a test target printed, or the tests of it whose names hold one of `names`.
pub fn printed(
    target: &str,
    names: &[&str],
    log: &Path,
    variables: &[(&str, &str)],
) -> Result<Vec<String>, String> {
    let mut command = test_target(target);
    command.args(["--", "--nocapture"]).args(names).envs(variables.iter().copied());
    let end = process::run_into(&mut command, log);
    let text = std::fs::read_to_string(log).unwrap_or_default();
    let lines = text.lines().skip_while(|line| !line.starts_with("running ")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with("test result"));
    let lines = lines.filter(|line| !line.starts_with("test ")).map(String::from).collect();
    end.map(|()| lines)
}

/// What the chain costs on the emulated board, against the bars and the table that was written.
pub fn cycles(log: &Path) -> End {
    install::emulator()?;
    let toolchain = Toolchain::find()?;
    if let Err(why) = process::run_into(firmware::bench_command(&toolchain).arg("--locked"), log) {
        return Ok(Err(why));
    }
    Ok(process::run_into(measuring(&toolchain)?.arg("--check"), log))
}

/// `cargo xtask cycles`: the table of what the chain costs on the emulated board.
pub fn show_cycles(args: &[String]) -> Result<(), String> {
    install::emulator()?;
    let toolchain = Toolchain::find()?;
    process::run(&mut firmware::bench_command(&toolchain))?;
    process::run(measuring(&toolchain)?.args(args))
}

/// The program that measures, up to its own options.
pub fn measuring(toolchain: &Toolchain) -> Result<Command, String> {
    let mut command = test_target("cycles");
    let image = firmware::bench_elf(toolchain);
    command.env("TAXEL_COMPILER", firmware::compiler(&image, toolchain)?);
    command.arg("--").env("TAXEL_BENCH_ELF", image);
    Ok(command)
}

/// Files and lines of the program as Python finds them; what was measured is shown.
pub fn python(log: &Path) -> End {
    shown(read_by_python(&[], log, &[])?)
}

/// What Python found.
pub fn read_by_python(names: &[&str], log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let python = install::python()?.to_string_lossy().into_owned();
    let variables = [variables, &[("TAXEL_PYTHON", python.as_str())]].concat();
    Ok(printed("python", names, log, &variables))
}

/// Every command that writes, on a disk that fails; what was tried is shown.
pub fn disk(log: &Path) -> End {
    shown(on_failing_disk(log, &[])?)
}

/// What was tried on a disk that fails.
pub fn on_failing_disk(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    if !cfg!(all(target_os = "linux", target_env = "gnu")) {
        return Err("a program's calls are made to fail on Linux with glibc alone".into());
    }
    let mut build = cargo(&["build", "--package", "taxel-disk"], paths::root());
    process::run_into(&mut build, log).map_err(|why| format!("what makes calls fail is not built: {why}"))?;
    let library = paths::target().join("debug/libtaxel_disk.so").to_string_lossy().into_owned();
    Ok(printed("disk", &[], log, &[variables, &[("TAXEL_DISK", library.as_str())]].concat()))
}

/// `cargo xtask soak`: boards that break and come back, recorded, watched and set anew for minutes.
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
    let mut command = test_target("library");
    command.args(["--", "--nocapture", "session::soak::"]).env("TAXEL_SOAK_MINUTES", minutes.to_string());
    process::run(&mut command)
}

/// Recordings through the pipeline, and recorded touches, recognised with people and days kept apart.
pub fn recorded(log: &Path) -> End {
    recordings::at_hand()?;
    Ok(process::run_into(&mut test_target("recorded"), log))
}

/// Recordings on the emulated board and on this machine.
pub fn emulator_recorded(log: &Path) -> End {
    recordings::at_hand()?;
    on_emulator("recorded", log)
}

/// `cargo xtask recorded`: the recordings through the pipeline, in the open.
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

/// `cargo xtask peers`: the core beside other libraries, in one run.
pub fn peers(args: &[String]) -> Result<(), String> {
    let mut command =
        cargo(&["bench", "--quiet", "--package", "taxel-tests", "--bench", "peers", "--"], paths::root());
    process::run(command.args(args))
}

/// One of the workspace's test targets.
pub fn test_target(name: &str) -> Command {
    let mut command = cargo(&[&["test"], WHOLE, &["--test", name]].concat(), paths::root());
    match recordings::listed() {
        Some(folders) => command.env(recordings::VARIABLE, folders),
        None => command.env_remove(recordings::VARIABLE),
    };
    command
}
