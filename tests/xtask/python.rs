//! `cargo xtask python`: the Python package as a wheel, tested in an environment of its own.

use crate::targets::{End, shown};
use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// The oldest CPython that the wheel is for, and the newest that it is tested with.
const VERSIONS: std::ops::RangeInclusive<u32> = 10..=13;
/// Longest time from the wheel to the first frame, s.
const FIRST_FRAME_S: f64 = 10.0;
/// Installations from nothing, of which the quickest counts.
const TRIES: usize = 3;
/// Frames over which a campaign watches the memory.
const FRAMES: &str = "1000000";
/// Folders of tests, and of what else mypy checks.
const TESTS: [&str; 2] = ["tests", "lerobot/tests"];
const TYPED: &[&str] = &["tests", "examples", "lerobot/lerobot_robot_taxel", "lerobot/tests"];
/// Prints the length of the first image.
const FIRST: &str = "import taxel; \
                     print(next(e.image.size for e in taxel.open('sim:pat') if isinstance(e, taxel.Frame)))";

/// How the wheel is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Build {
    /// By the dev profile, like the other tests.
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
    let lines =
        tested("python3", build, &log, &[])?.map_err(|why| format!("{why}, see {}", log.display()))?;
    lines.iter().for_each(|line| println!("{line}"));
    Ok(())
}

/// The check: the wheel with the `python3` that is there.
pub fn check(log: &Path) -> End {
    shown(tested("python3", Build::Dev, log, &[])?)
}

/// The campaign: the wheel that is given away, with each CPython that is there, installed from nothing.
pub fn campaign(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let found: Vec<String> = VERSIONS.filter_map(interpreter).collect();
    if found.is_empty() {
        return Err("there is no python3.10 or later".into());
    }
    let variables = [variables, &[("TAXEL_FRAMES", FRAMES)]].concat();
    let mut lines = Vec::new();
    for python in &found {
        match tested(python, Build::Release, log, &variables)? {
            Ok(said) => lines.extend(said),
            Err(why) => return Ok(Err(format!("{python}: {why}"))),
        }
        // What else the machine does only adds to the time: the quickest counts.
        let tries = (0..TRIES).map(|_| from_nothing(python, log));
        let quickest = tries.reduce(|a, b| match (a, b) {
            (Ok(a), Ok(b)) => Ok(a.min(b)),
            (Ok(quick), Err(_)) | (Err(_), Ok(quick)) => Ok(quick),
            (Err(why), Err(_)) => Err(why),
        });
        match quickest.unwrap_or_else(|| Err("nothing was tried".into())) {
            Ok(seconds) => {
                let [major, minor] = version(python).unwrap_or_default();
                let what = "from pip install to the first frame";
                lines.push(format!("CPython {major}.{minor}: {what} {seconds:.1} s"));
            }
            Err(why) => return Ok(Err(format!("{python}: {why}"))),
        }
    }
    let missing = VERSIONS.filter(|minor| interpreter(*minor).is_none()).map(|minor| format!("3.{minor}"));
    lines.extend(missing.map(|version| format!("CPython {version}: not run: it is not here")));
    Ok(Ok(lines))
}

/// Name or path of the CPython of this version: on the PATH, or one that pyenv has installed.
pub fn interpreter(minor: u32) -> Option<String> {
    let is_it = |python: &str| version(python).is_some_and(|[_, have]| have == minor);
    let named = format!("python3.{minor}");
    if is_it(&named) {
        return Some(named);
    }
    let root = process::output(Command::new("pyenv").arg("root"))?;
    let folders = std::fs::read_dir(Path::new(&root).join("versions")).ok()?.flatten();
    let pythons = folders.map(|folder| folder.path().join("bin/python").display().to_string());
    pythons.into_iter().find(|python| is_it(python))
}

/// Version of an interpreter.
fn version(python: &str) -> Option<[u32; 2]> {
    let told =
        process::output(Command::new(python).args(["-c", "import sys; print(*sys.version_info[:2])"]))?;
    let mut numbers = told.split(' ').map(str::parse);
    Some([numbers.next()?.ok()?, numbers.next()?.ok()?])
}

/// Builds the wheel, installs it beside the pinned tools, and runs the tests and mypy. Returns what they
/// measured.
fn tested(python: &str, build: Build, log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let [major, minor] = install::python3(python).map(|()| version(python).unwrap_or_default())?;
    if (major, minor) < (3, *VERSIONS.start()) {
        return Err(format!("{python} is {major}.{minor}, and the package is for 3.10 and later"));
    }
    let own = environment(python, minor)?;
    Ok(steps(&own, build, log, variables).map(|lines| {
        let head = format!("CPython 3.{minor}:");
        lines.into_iter().map(|line| format!("{head} {line}")).collect()
    }))
}

/// Builds the wheel that is given away.
pub fn wheel(python: &str, log: &Path) -> End<PathBuf> {
    let [_, minor] = install::python3(python).map(|()| version(python).unwrap_or_default())?;
    Ok(built(&environment(python, minor)?, Build::Release, log))
}

/// The environment with the pinned tools; its interpreter.
fn environment(python: &str, minor: u32) -> Result<PathBuf, String> {
    let folder = paths::target().join(format!("xtask/wheel-3.{minor}"));
    install::python_in(python, &folder, &package().join("tests/requirements.txt"))
}

fn steps(python: &Path, build: Build, log: &Path, variables: &[(&str, &str)]) -> Result<Vec<String>, String> {
    let wheel = built(python, build, log)?;
    let mut install = Command::new(python);
    install.args(["-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall"]).arg(&wheel);
    process::run_into(&mut install, log)?;
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
    let measured = said.lines().filter(|line| line.contains("resident memory") || line.contains("of a core"));
    let mut lines: Vec<String> = measured.map(String::from).collect();
    let bytes = std::fs::metadata(&wheel).map_or(0, |data| data.len());
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
    if build == Build::Release {
        maturin.args(["--release", "--features", "full"]);
    }
    process::run_into(&mut maturin, log)?;
    let found = std::fs::read_dir(&out).ok().and_then(|mut files| files.next()).and_then(Result::ok);
    found.map(|file| file.path()).ok_or("maturin has built no wheel".into())
}

/// Seconds from the wheel to the first frame in an environment that did not exist before.
fn from_nothing(python: &str, log: &Path) -> Result<f64, String> {
    let folder = paths::target().join("xtask/wheel-new");
    let _ = std::fs::remove_dir_all(&folder);
    process::run_into(Command::new(python).args(["-m", "venv"]).arg(&folder), log)?;
    let own = folder.join("bin/python");
    let wheel = std::fs::read_dir(paths::target().join("wheels")).ok().and_then(|mut files| files.next());
    let wheel = wheel.and_then(Result::ok).ok_or("there is no wheel")?.path();
    let began = Instant::now();
    process::run_into(Command::new(&own).args(["-m", "pip", "install", "--quiet"]).arg(&wheel), log)?;
    let first = process::output(Command::new(&own).args(["-c", FIRST]).current_dir(&folder));
    let seconds = began.elapsed().as_secs_f64();
    match first.as_deref() {
        Some("2048") if seconds <= FIRST_FRAME_S => Ok(seconds),
        Some("2048") => Err(format!("from pip install to the first frame {seconds:.1} s")),
        _ => Err("there was no first frame".into()),
    }
}

/// The package's folder.
fn package() -> PathBuf {
    paths::root().join("host/python")
}
