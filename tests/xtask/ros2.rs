//! `cargo xtask ros2`: the ROS 2 node, against ROS itself: wheels of a third party, pinned by hash, in an
//! environment for each distribution, with our messages built into it.

use crate::cargo::{WHOLE, cargo};
use crate::end::{End, shown};
use crate::{install, interpreter, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Distributions, and the minor version of the Python 3 that each is for.
const DISTRIBUTIONS: [(&str, u32); 2] = [("kilted", 11), ("jazzy", 12)];
/// How the tests' own lines begin.
const SAID: &str = "ros2: ";

/// `cargo xtask ros2`: the short form, with each distribution that can be had.
pub fn run(args: &[String]) -> Result<(), String> {
    if !args.is_empty() {
        return Err(crate::USAGE.into());
    }
    let log = paths::log("ros2")?;
    let lines = all(&log, &[])?.map_err(|why| format!("{why}, see {}", log.display()))?;
    lines.iter().for_each(|line| println!("{line}"));
    Ok(())
}

/// The check: the short form, with the first distribution whose Python is there.
pub fn check(log: &Path) -> End {
    let found =
        DISTRIBUTIONS.into_iter().find_map(|(name, minor)| Some((name, interpreter::interpreter(minor)?)));
    let (name, python) = found.ok_or("there is neither python3.11 for Kilted nor python3.12 for Jazzy")?;
    shown(tested(name, &python, log, &[])?)
}

/// The campaign: all of it, with each distribution that can be had.
pub fn campaign(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    all(log, variables)
}

fn all(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let mut lines = Vec::new();
    let mut ran = 0;
    for (name, minor) in DISTRIBUTIONS {
        let Some(python) = interpreter::interpreter(minor) else {
            lines.push(format!("{name}: not run: there is no python3.{minor}"));
            continue;
        };
        match tested(name, &python, log, variables)? {
            Ok(said) => lines.extend(said),
            Err(why) => return Ok(Err(format!("{name}: {why}"))),
        }
        ran += 1;
    }
    if ran == 0 { Err(lines.join("; ")) } else { Ok(Ok(lines)) }
}

/// Runs the tests with a distribution. Returns what they measured.
fn tested(name: &str, python: &str, log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let folder = paths::target().join(format!("xtask/ros2-{name}"));
    let wanted = package().join(format!("tests/{name}.txt"));
    let own = install::python_in(python, &folder, &wanted)
        .map_err(|why| format!("the wheels of ROS 2 {name} cannot be had: {why}"))?;
    Ok(steps(name, &folder, &own, log, variables))
}

fn steps(
    name: &str,
    folder: &Path,
    python: &Path,
    log: &Path,
    variables: &[(&str, &str)],
) -> Result<Vec<String>, String> {
    messages(folder, python, log)?;
    let program = program(folder, log)?;
    let mut pytest = Command::new(python);
    pytest.args(["-m", "pytest", "-p", "no:cacheprovider", "-rP"]).arg(package().join("tests"));
    pytest
        .env("TAXEL_PROGRAM", program)
        .env("PATH", process::path_with(folder)?)
        .current_dir(paths::target());
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    process::run_into(pytest.envs(variables.iter().copied()), log)?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let lines = said.get(before..).unwrap_or_default().lines().filter_map(|line| line.strip_prefix(SAID));
    Ok(lines.map(|line| format!("{name}: {line}")).collect())
}

/// Builds our messages into an environment, unless it has them as they are.
fn messages(folder: &Path, python: &Path, log: &Path) -> Result<(), String> {
    let source = package().join("taxel_msgs");
    let wanted = contents(&source)?;
    // The environment's own list: a new environment has no messages.
    let note = folder.join("taxel_msgs.txt");
    if std::fs::read_to_string(&note).is_ok_and(|built| built == wanted) {
        return Ok(());
    }
    let build = folder.join("taxel_msgs");
    let _ = std::fs::remove_dir_all(&build);
    let cmake = |args: &[&str]| -> Result<Command, String> {
        let mut command = Command::new(folder.join("bin/cmake"));
        command.args(args).env("PATH", process::path_with(folder)?);
        command.env("AMENT_PREFIX_PATH", folder).env("CMAKE_PREFIX_PATH", folder);
        Ok(command)
    };
    let prefix = format!("-DCMAKE_INSTALL_PREFIX={}", folder.display());
    let python = format!("-DPython3_EXECUTABLE={}", python.display());
    let mut configure = cmake(&["-DBUILD_TESTING=OFF", &prefix, &python, "-S"])?;
    // It complains of a folder of the machine that built the wheels, and what it has written can be built.
    let _ = process::run_into(configure.arg(&source).arg("-B").arg(&build), log);
    process::run_into(cmake(&["--build"])?.arg(&build), log)?;
    process::run_into(cmake(&["--install"])?.arg(&build), log)?;
    std::fs::write(&note, wanted).map_err(|error| format!("{}: {error}", note.display()))
}

/// Texts of all files of a folder and its folders, each behind its path.
fn contents(folder: &Path) -> Result<String, String> {
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(fail)?;
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>().map_err(fail)?;
    paths.sort();
    let of = |path: &PathBuf| {
        if path.is_dir() {
            return contents(path);
        }
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(format!("{}\n{text}", path.display()))
    };
    paths.iter().map(of).collect()
}

/// The program that the other tests have built, with all features; a copy, which no other build replaces.
fn program(folder: &Path, log: &Path) -> Result<PathBuf, String> {
    let build = [&["test"], WHOLE, &["--test", "program", "--no-run"]].concat();
    process::run_into(&mut cargo(&build, paths::root()), log)?;
    let copy = folder.join("bin/taxel");
    // One that still runs is not overwritten.
    let _ = std::fs::remove_file(&copy);
    let built = paths::target().join("debug/taxel");
    std::fs::copy(&built, &copy).map_err(|error| format!("{}: {error}", built.display()))?;
    Ok(copy)
}

/// The package of messages, and the tests beside it.
fn package() -> PathBuf {
    paths::root().join("host/ros2")
}
