//! Campaigns of the Python package, as it is given away, beside other people's programs, each in an environment of its
//! own: LeRobot, of some 5 GB, and Ray.

use crate::end::End;
use crate::{install, interpreter, paths, process, python};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program of other people.
#[derive(Debug, Clone, Copy)]
pub struct Guest {
    /// Its name, with which the lines of its tests begin.
    name: &'static str,
    /// Minor version of the Python 3 that it is tested with.
    minor: u32,
    /// Folder of its tests and pinned packages, in that of the package.
    tests: &'static str,
    /// Folder of a package of ours that it needs.
    also: Option<&'static str>,
}

/// LeRobot with the plug-in.
pub const LEROBOT: Guest =
    Guest { name: "lerobot", minor: 12, tests: "lerobot/stock", also: Some("lerobot") };
/// Ray with the example of many recordings.
pub const RAY: Guest = Guest { name: "fleet", minor: 11, tests: "fleet", also: None };

/// Runs the tests of a program. Returns what was measured.
pub fn campaign(guest: Guest, log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let Guest { name, minor, tests, .. } = guest;
    let interpreter = interpreter::interpreter(minor).ok_or(format!("there is no python3.{minor}"))?;
    let wheel = match python::wheel(&interpreter, log)? {
        Ok(wheel) => wheel,
        Err(why) => return Ok(Err(why)),
    };
    let pinned = interpreter::package().join(tests).join("requirements.txt");
    let own = install::python_in(&interpreter, &folder(name), &pinned)
        .map_err(|why| format!("what {name} needs cannot be had: {why}"))?;
    Ok(steps(guest, &own, &wheel, log, variables))
}

fn steps(
    guest: Guest,
    python: &Path,
    wheel: &Path,
    log: &Path,
    variables: &[(&str, &str)],
) -> Result<Vec<String>, String> {
    let Guest { name, tests, also, .. } = guest;
    let package = interpreter::package();
    for what in [Some(wheel.to_path_buf()), also.map(|also| package.join(also))].into_iter().flatten() {
        let mut install = Command::new(python);
        install.args(["-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall"]).arg(what);
        process::run_into(&mut install, log)?;
    }
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    let mut pytest = Command::new(python);
    pytest.args(["-m", "pytest", "-p", "no:cacheprovider", "-rP"]).arg(package.join(tests));
    pytest.arg("--basetemp").arg(folder(&format!("{name}-sets")));
    process::run_into(pytest.current_dir(paths::target()).envs(variables.iter().copied()), log)?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let own = format!("{name}: ");
    let lines = said.get(before..).unwrap_or_default().lines();
    Ok(lines.filter_map(|line| line.strip_prefix(own.as_str())).map(String::from).collect())
}

/// A folder for a run.
fn folder(name: &str) -> PathBuf {
    paths::target().join("xtask").join(name)
}
