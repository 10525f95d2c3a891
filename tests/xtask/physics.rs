//! `cargo xtask campaign --only physics`: MuJoCo judges places and forces (`tests/physics`), in an
//! environment of its own with the wheel that is given away.

use crate::end::End;
use crate::{install, interpreter, paths, process, python};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Minor versions of the Python 3 that MuJoCo's wheels are for.
const VERSIONS: std::ops::RangeInclusive<u32> = 11..=13;

/// Runs the package's tests and its types. Returns the tables that they print.
pub fn campaign(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let found = VERSIONS.into_iter().find_map(|minor| Some((minor, interpreter::interpreter(minor)?)));
    let (minor, interpreter) = found.ok_or("there is no python3.11 or later")?;
    let wheel = match python::wheel(&interpreter, log)? {
        Ok(wheel) => wheel,
        Err(why) => return Ok(Err(why)),
    };
    let folder = paths::target().join(format!("xtask/physics-3.{minor}"));
    let own = install::python_in(&interpreter, &folder, &package().join("requirements.txt"))
        .map_err(|why| format!("MuJoCo cannot be had: {why}"))?;
    Ok(steps(&own, &wheel, log, variables))
}

fn steps(python: &Path, wheel: &Path, log: &Path, variables: &[(&str, &str)]) -> Result<Vec<String>, String> {
    let run = |args: &[&str], path: &Path| {
        let mut command = Command::new(python);
        command.arg("-m").args(args).arg(path).env("PYTHONPATH", package());
        process::run_into(command.current_dir(paths::target()).envs(variables.iter().copied()), log)
    };
    run(&["pip", "install", "--quiet", "--no-deps", "--force-reinstall"], wheel)?;
    let config = package().join("pyproject.toml").display().to_string();
    let cache = paths::target().join("xtask/mypy").display().to_string();
    for folder in ["taxel_physics", "tests"] {
        run(&["mypy", "--strict", "--config-file", &config, "--cache-dir", &cache], &package().join(folder))?;
    }
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    run(&["pytest", "-p", "no:cacheprovider"], &package().join("tests"))?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let tables =
        said.get(before..).unwrap_or_default().lines().skip_while(|line| !line.contains("[100%]")).skip(1);
    Ok(tables.map(String::from).collect())
}

/// The Python package of the physics.
fn package() -> PathBuf {
    paths::root().join("tests/physics")
}
