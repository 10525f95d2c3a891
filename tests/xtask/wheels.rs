//! What is given away of the Python package: wheels for Linux on x86-64 and on aarch64, linked by zig against
//! the C library of 2018, and a source distribution.

use crate::end::End;
use crate::{aarch64, install, interpreter, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Targets of the wheels: that of the machine on which they are tested, and the other.
pub const HERE: &str = "x86_64-unknown-linux-gnu";
pub const AARCH64: &str = "aarch64-unknown-linux-gnu";
/// The C library that programs and wheels need on Linux: the first with the call that exchanges two names (`renameat2`).
pub const GLIBC: &str = "2.28";
/// That library, as wheels name it.
const PLATFORM: &str = "manylinux_2_28";

/// Builds the wheel for x86-64.
pub fn here(interpreter: &str, log: &Path) -> End<PathBuf> {
    Ok(wheel(&tools(interpreter)?, HERE, log))
}

/// `cargo xtask campaign --only python-others`: what the CPythons of this machine do not install: the wheel for
/// aarch64 is imported, and the source distribution is built by pip.
pub fn campaign(log: &Path) -> End<Vec<String>> {
    let interpreter = interpreter::newest().ok_or("there is no python3.10 or later")?;
    let tools = tools(&interpreter)?;
    let lines =
        foreign(&tools, &interpreter, log).and_then(|one| Ok(vec![one, source(&tools, &interpreter, log)?]));
    Ok(lines)
}

/// Builds the wheel for aarch64, and imports it if an interpreter can be had.
fn foreign(tools: &Path, interpreter: &str, log: &Path) -> Result<String, String> {
    let wheel = wheel(tools, AARCH64, log)?;
    let python = match aarch64::python(interpreter, log) {
        Ok(python) => python,
        Err(why) => return Ok(format!("{}: not imported: {why}", shown(&wheel))),
    };
    python.install(&wheel, log)?;
    interpreter::first_image(&mut python.command())?;
    Ok(format!("{}: imported by CPython {}, its first image seen", shown(&wheel), aarch64::SHOWN))
}

/// Makes a source distribution, and installs it by pip in an environment of its own; then the package as README says,
/// whose command has all features.
fn source(tools: &Path, interpreter: &str, log: &Path) -> Result<String, String> {
    let source = maturin(tools, "sdist", &[], "source", |make| process::run_into(make, log))?;
    let own = install::new_python(interpreter, &paths::target().join("xtask/source-new"), log)?;
    let mut install = Command::new(&own);
    install.args(["-m", "pip", "install", "--quiet"]).arg(&source);
    // What cargo has built already of its dependencies is the same.
    process::run_into(install.env("CARGO_TARGET_DIR", paths::target()), log)?;
    interpreter::first_image(&mut Command::new(&own))?;
    let folder = own.parent().and_then(Path::parent).ok_or("an environment without a folder")?;
    for line in ["pip install --force-reinstall ./host/python", "taxel ros2 --source sim:pat --for 1s"] {
        let mut typed = Command::new("sh");
        typed.args(["-c", line]).current_dir(paths::root()).env("PATH", process::path_with(folder)?);
        process::run_into(&mut typed, log)?;
    }
    Ok(format!("{}: built and installed by pip, its first image seen; as README says, too", shown(&source)))
}

/// The environment with maturin, zig and cargo-zigbuild; its interpreter.
pub fn tools(interpreter: &str) -> Result<PathBuf, String> {
    install::python_in(interpreter, &folder(), &interpreter::package().join("tests/wheels.txt"))
}

/// The folder of that environment.
pub fn folder() -> PathBuf {
    paths::target().join("xtask/wheels")
}

fn wheel(tools: &Path, target: &str, log: &Path) -> Result<PathBuf, String> {
    add_target(target, log)?;
    maturin(tools, "build", &options(target), target, |build| process::run_into(build, log))
}

/// Installs the compiler's library for a target.
pub fn add_target(target: &str, log: &Path) -> Result<(), String> {
    process::run_into(Command::new("rustup").args(["target", "add", target]), log)
}

/// Options of maturin for a wheel that is given away.
pub fn options(target: &str) -> Vec<&str> {
    // For Windows, maturin's own `--zig` has the linker export a name with a dot, which is none.
    let linked: &[&str] =
        if target.contains("linux") { &["--zig", "--compatibility", PLATFORM] } else { &[] };
    [&["--release", "--locked", "--target", target], linked].concat()
}

/// Hands the linker's words to zig. A list of exported names is a file to it, and no option of the linker.
const LINKER: &str = "#!/bin/sh
for word do
    shift
    case \"$word\" in -Wl,*.def) word=\"${word#-Wl,}\" ;; esac
    set -- \"$@\" \"$word\"
done
exec cargo-zigbuild zig cc -- -g -fno-sanitize=all -target TARGET \"$@\"
";
/// Makes libraries of a DLL's names, as rustc asks for them.
const DLLTOOL: &str = "#!/bin/sh\nexec python3 -m ziglang dlltool \"$@\"\n";

/// Variables by which programs and wheels for a target have the same linker: cargo builds anew what was built for another
/// one, and cargo-zigbuild and maturin each bring their own. None where zig does not link.
pub fn linker(target: &str) -> Result<Vec<(String, String)>, String> {
    let zig = match target.split('-').collect::<Vec<_>>()[..] {
        [machine, _, "linux", "gnu"] => format!("{machine}-linux-gnu.{GLIBC}"),
        [machine, _, "windows", "gnu"] => format!("{machine}-windows-gnu"),
        _ => return Ok(Vec::new()),
    };
    let linker = program(&format!("zigcc-{zig}"), &LINKER.replace("TARGET", &zig))?;
    let variable = format!("CARGO_TARGET_{}_LINKER", target.to_uppercase().replace('-', "_"));
    let mut variables = vec![(variable, linker)];
    if target.contains("windows") {
        program("x86_64-w64-mingw32-dlltool", DLLTOOL)?;
        // As cargo-zigbuild has it: zig brings these libraries.
        variables.push(("WINAPI_NO_BUNDLED_LIBRARIES".into(), "1".into()));
    }
    Ok(variables)
}

/// Writes a script among the programs of the environment; its path.
fn program(name: &str, text: &str) -> Result<String, String> {
    let script = folder().join("bin").join(name).display().to_string();
    std::fs::write(&script, text).map_err(|error| format!("{script}: {error}"))?;
    process::run(Command::new("chmod").args(["+x", &script]))?;
    Ok(script)
}

/// Runs a command of maturin that makes one file, in a folder of its own.
pub fn maturin(
    tools: &Path,
    command: &str,
    options: &[&str],
    name: &str,
    run: impl FnOnce(&mut Command) -> Result<(), String>,
) -> Result<PathBuf, String> {
    let out = paths::target().join("given").join(name);
    let _ = std::fs::remove_dir_all(&out);
    let mut maturin = Command::new(tools);
    maturin.args(["-m", "maturin", command]).args(options).arg("--out").arg(&out).arg("--manifest-path");
    // It looks for zig on the search path.
    maturin.arg(interpreter::package().join("Cargo.toml")).env("PATH", process::path_with(&folder())?);
    run(&mut maturin)?;
    let found = std::fs::read_dir(&out).ok().and_then(|mut files| files.next()).and_then(Result::ok);
    found.map(|file| file.path()).ok_or(format!("maturin {command} has made no file"))
}

/// Name and size of a file.
pub fn shown(file: &Path) -> String {
    let bytes = std::fs::metadata(file).map_or(0, |data| data.len());
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    format!("{name} of {:.1} MB", bytes as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Links of a repository are texts on Windows: the package has copies of the licences.
    #[test]
    fn nothing_in_the_repository_is_a_link() {
        let mut list = Command::new("git");
        let listed = process::output(list.args(["ls-files", "--stage"]).current_dir(paths::root())).unwrap();
        let links: Vec<&str> = listed.lines().filter(|line| line.starts_with("120000")).collect();
        assert!(listed.lines().count() > 1000 && links.is_empty(), "{links:?}");
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let [a, b] =
                [paths::root(), interpreter::package()].map(|folder| std::fs::read(folder.join(licence)));
            assert!(a.unwrap() == b.unwrap(), "{licence}");
        }
    }
}
