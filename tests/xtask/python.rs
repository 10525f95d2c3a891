//! `cargo xtask python`: the Python package as a wheel, tested in an environment of its own.

use crate::cargo::without_increments;
use crate::end::{End, shown};
use crate::interpreter::{VERSIONS, first_image, interpreter, minor, package, version};
use crate::{install, paths, process, wheels};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::Instant;

/// Longest time from the wheel to the first frame, s.
const FIRST_FRAME_S: f64 = 10.0;
/// Installations from nothing, of which the quickest counts.
const TRIES: usize = 3;
/// Frames over which a campaign watches the memory.
const FRAMES: &str = "1000000";
/// Folders of tests, and of what else mypy checks.
const TESTS: [&str; 2] = ["tests", "lerobot/tests"];
const TYPED: &[&str] = &["tests", "examples", "lerobot/lerobot_robot_taxel", "lerobot/tests"];
/// How the wheel is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Build {
    /// By the dev profile, like the other tests, and with all that the command can do.
    Dev,
    /// For users: by the release profile, with all that the command can do.
    Release,
}

/// `cargo xtask python`: builds and tests the wheel; `--release`: as it is given away.
pub fn run(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let build = match args[..] {
        [] => Build::Dev,
        ["--release"] => Build::Release,
        _ => return Err(crate::USAGE.into()),
    };
    let log = paths::log("wheel")?;
    let lines = tested("python3", |own| built(own, build, &log), &log, &[])?
        .map_err(|why| format!("{why}, see {}", log.display()))?;
    lines.iter().for_each(|line| println!("{line}"));
    Ok(())
}

/// The check: the wheel with the `python3` that is there.
pub fn check(log: &Path) -> End {
    shown(tested("python3", |own| built(own, Build::Dev, log), log, &[])?)
}

/// The campaign: the wheel that is given away, with each CPython that is there, installed from nothing.
pub fn campaign(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let found: Vec<String> = VERSIONS.filter_map(interpreter).collect();
    let newest = found.last().ok_or("there is no python3.10 or later")?;
    let wheel = match wheels::here(newest, log)? {
        Ok(wheel) => wheel,
        Err(why) => return Ok(Err(why)),
    };
    let variables = [variables, &[("TAXEL_FRAMES", FRAMES)]].concat();
    // A million frames take each of them minutes.
    let reported: Vec<_> = thread::scope(|scope| {
        let run = |python: &'_ String| {
            let (python, log) = (python.clone(), log.with_extension(format!("{}.log", minor(python))));
            let _ = std::fs::remove_file(&log);
            let (wheel, variables) = (wheel.clone(), &variables);
            scope.spawn(move || tested(&python, |_| Ok(wheel), &log, variables))
        };
        let runs: Vec<_> = found.iter().map(run).collect();
        runs.into_iter().map(|run| run.join().unwrap_or_else(|_| Err("its thread ended".into()))).collect()
    });
    let mut lines = vec![wheels::shown(&wheel)];
    for (python, reported) in found.iter().zip(reported) {
        match reported? {
            Ok(said) => lines.extend(said),
            Err(why) => return Ok(Err(format!("{python}: {why}"))),
        }
        // What else the machine does only adds to the time: the quickest counts.
        let tries = (0..TRIES).map(|_| from_nothing(python, &wheel, log));
        let quickest = tries.reduce(|a, b| match (a, b) {
            (Ok(a), Ok(b)) => Ok(a.min(b)),
            (Ok(quick), Err(_)) | (Err(_), Ok(quick)) => Ok(quick),
            (Err(why), Err(_)) => Err(why),
        });
        match quickest.unwrap_or_else(|| Err("nothing was tried".into())) {
            Ok(seconds) => {
                let what = "from pip install to the first frame";
                lines.push(format!("CPython 3.{}: {what} {seconds:.1} s", minor(python)));
            }
            Err(why) => return Ok(Err(format!("{python}: {why}"))),
        }
    }
    let missing = VERSIONS.filter(|minor| interpreter(*minor).is_none()).map(|minor| format!("3.{minor}"));
    lines.extend(missing.map(|version| format!("CPython {version}: not run: it is not here")));
    Ok(Ok(lines))
}

/// Makes a wheel by an environment with the pinned tools, installs it beside them, and runs the tests and
/// mypy. Returns what they measured.
fn tested(
    python: &str,
    wheel: impl FnOnce(&Path) -> Result<PathBuf, String>,
    log: &Path,
    variables: &[(&str, &str)],
) -> End<Vec<String>> {
    let [major, minor] = install::python3(python).map(|()| version(python).unwrap_or_default())?;
    if (major, minor) < (3, *VERSIONS.start()) {
        return Err(format!("{python} is {major}.{minor}, and the package is for 3.10 and later"));
    }
    let own = environment(python, minor)?;
    let lines = wheel(&own).and_then(|wheel| steps(&own, &wheel, log, variables));
    Ok(lines.map(|lines| {
        let head = format!("CPython 3.{minor}:");
        lines.into_iter().map(|line| format!("{head} {line}")).collect()
    }))
}

/// Builds the wheel as it is given away, for this machine alone.
pub fn wheel(python: &str, log: &Path) -> End<PathBuf> {
    let [_, minor] = install::python3(python).map(|()| version(python).unwrap_or_default())?;
    Ok(built(&environment(python, minor)?, Build::Release, log))
}

/// The environment with the pinned tools; its interpreter.
fn environment(python: &str, minor: u32) -> Result<PathBuf, String> {
    let folder = paths::target().join(format!("xtask/wheel-3.{minor}"));
    install::python_in(python, &folder, &package().join("tests/requirements.txt"))
}

fn steps(python: &Path, wheel: &Path, log: &Path, variables: &[(&str, &str)]) -> Result<Vec<String>, String> {
    let mut install = Command::new(python);
    install.args(["-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall"]).arg(wheel);
    process::run_into(&mut install, log)?;
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    let mut pytest = Command::new(python);
    pytest.args(["-m", "pytest", "-p", "no:cacheprovider", "-rP"]);
    pytest.args(TESTS.map(|folder| package().join(folder)));
    pytest.current_dir(paths::target()).envs(variables.iter().copied());
    process::run_into(&mut pytest, log)?;
    // The package itself, as it is installed, then what uses it.
    let package_itself: &[&str] = &["-p", "taxel"];
    for what in [package_itself, TYPED] {
        let mut mypy = Command::new(python);
        mypy.args(["-m", "mypy", "--strict", "--cache-dir"]).arg(paths::target().join("xtask/mypy"));
        mypy.args(what).current_dir(package()).env("MYPYPATH", "lerobot");
        process::run_into(&mut mypy, log)?;
    }
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let said = said.get(before..).unwrap_or_default().lines();
    let measured = said.filter(|line| line.contains("resident memory") || line.contains("of a core"));
    let mut lines: Vec<String> = measured.map(String::from).collect();
    let bytes = std::fs::metadata(wheel).map_or(0, |data| data.len());
    lines.push(format!("wheel of {:.1} MB", bytes as f64 / 1e6));
    Ok(lines)
}

/// Builds the wheel.
fn built(python: &Path, build: Build, log: &Path) -> Result<PathBuf, String> {
    let out = paths::target().join("wheels");
    // One wheel is to be found there.
    let _ = std::fs::remove_dir_all(&out);
    let mut maturin = Command::new(python);
    maturin.args(["-m", "maturin", "build", "--locked", "--out"]).arg(&out).arg("--manifest-path");
    maturin.arg(package().join("Cargo.toml"));
    match build {
        // As all tests have it, so that cargo compiles little but the package itself.
        Build::Dev => maturin.args(["--strip", "false", "--features", "full,taxel/full,taxel-cli/full"]),
        Build::Release => maturin.arg("--release"),
    };
    without_increments(&mut maturin);
    process::run_into(&mut maturin, log)?;
    let found = std::fs::read_dir(&out).ok().and_then(|mut files| files.next()).and_then(Result::ok);
    found.map(|file| file.path()).ok_or("maturin has built no wheel".into())
}

/// Seconds from the wheel to the first frame in an environment that did not exist before.
fn from_nothing(python: &str, wheel: &Path, log: &Path) -> Result<f64, String> {
    let own = install::new_python(python, &paths::target().join("xtask/wheel-new"), log)?;
    let began = Instant::now();
    process::run_into(Command::new(&own).args(["-m", "pip", "install", "--quiet"]).arg(wheel), log)?;
    let first = first_image(&mut Command::new(&own));
    let seconds = began.elapsed().as_secs_f64();
    match first {
        Ok(()) if seconds <= FIRST_FRAME_S => Ok(seconds),
        Ok(()) => Err(format!("from pip install to the first frame {seconds:.1} s")),
        Err(why) => Err(why),
    }
}
