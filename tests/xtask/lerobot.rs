//! `cargo xtask campaign --only lerobot`: the plug-in in LeRobot itself, of some 5 GB, in an environment of its own
//! with the wheel that is given away.

use crate::end::End;
use crate::{install, interpreter, paths, process, python};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Minor version of the Python 3 that its pinned packages are for.
const MINOR: u32 = 12;
/// How the tests' own lines begin.
const SAID: &str = "lerobot: ";

/// Records and loads data sets. Returns what was measured.
pub fn campaign(log: &Path, variables: &[(&str, &str)]) -> End<Vec<String>> {
    let interpreter = interpreter::interpreter(MINOR).ok_or(format!("there is no python3.{MINOR}"))?;
    let wheel = match python::wheel(&interpreter, log)? {
        Ok(wheel) => wheel,
        Err(why) => return Ok(Err(why)),
    };
    let folder = paths::target().join("xtask/lerobot");
    let own = install::python_in(&interpreter, &folder, &package().join("stock/requirements.txt"))
        .map_err(|why| format!("LeRobot cannot be had: {why}"))?;
    Ok(steps(&own, &wheel, log, variables))
}

fn steps(python: &Path, wheel: &Path, log: &Path, variables: &[(&str, &str)]) -> Result<Vec<String>, String> {
    for what in [wheel, &package()] {
        let mut install = Command::new(python);
        install.args(["-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall"]).arg(what);
        process::run_into(&mut install, log)?;
    }
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    let mut pytest = Command::new(python);
    pytest.args(["-m", "pytest", "-p", "no:cacheprovider", "-rP"]).arg(package().join("stock"));
    pytest.arg("--basetemp").arg(paths::target().join("xtask/lerobot-sets"));
    process::run_into(pytest.current_dir(paths::target()).envs(variables.iter().copied()), log)?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let lines = said.get(before..).unwrap_or_default().lines().filter_map(|line| line.strip_prefix(SAID));
    Ok(lines.map(String::from).collect())
}

/// The plug-in's package.
fn package() -> PathBuf {
    interpreter::package().join("lerobot")
}
