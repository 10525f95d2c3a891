//! A CPython for aarch64 on this machine: Debian's, run by its qemu-user. Packages are unpacked into a folder of their
//! own; the machine's own list of packages does not know of them.

use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What it is, in words.
pub const SHOWN: &str = "3.11 of Debian for aarch64, run by qemu-user";
/// Debian's packages for aarch64: what they depend on comes with them.
const PACKAGES: [&str; 4] = ["python3.11-minimal", "libpython3.11-stdlib", "libstdc++6", "libgcc-s1"];
/// Version of this CPython, for pip.
const VERSION: &str = "3.11";

/// An interpreter with a folder of packages.
#[derive(Debug, Clone)]
pub struct ForeignPython {
    /// An interpreter of this machine, whose pip installs.
    host: String,
    qemu: PathBuf,
    root: PathBuf,
    site: PathBuf,
}

/// Unpacks it, unless it is there already. The error says why it cannot be had.
pub fn python(host: &str, log: &Path) -> Result<ForeignPython, String> {
    if !process::exists("apt-get") {
        return Err("there is no apt-get to fetch qemu-user and an interpreter".into());
    }
    let folder = paths::target().join("xtask/aarch64");
    let python = ForeignPython {
        host: host.into(),
        qemu: folder.join("qemu/usr/bin/qemu-aarch64-static"),
        root: folder.join("root"),
        site: folder.join("site"),
    };
    let runs = |python: &ForeignPython| process::output(python.command().arg("--version")).is_some();
    if !runs(&python) {
        unpack(&folder, log)?;
    }
    if runs(&python) { Ok(python) } else { Err("the interpreter does not run".into()) }
}

/// Fetches Debian's packages, and unpacks them.
fn unpack(folder: &Path, log: &Path) -> Result<(), String> {
    let state = |name: &str| folder.join("apt").join(name);
    for name in ["state/lists/partial", "cache/archives/partial", "emulator"] {
        std::fs::create_dir_all(state(name))
            .map_err(|error| format!("{}: {error}", state(name).display()))?;
    }
    let config = format!(
        "APT::Architecture \"arm64\";\nAPT::Architectures {{ \"arm64\"; }};\nDir::State \"{}\";\n\
         Dir::State::status \"{}\";\nDir::Cache \"{}\";\n",
        state("state").display(),
        state("status").display(),
        state("cache").display()
    );
    for (name, text) in [("status", ""), ("apt.conf", &config)] {
        std::fs::write(state(name), text).map_err(|error| format!("{}: {error}", state(name).display()))?;
    }
    let apt = |args: &[&str]| {
        let mut command = Command::new("apt-get");
        command.args(args).env("APT_CONFIG", state("apt.conf")).env("DEBIAN_FRONTEND", "noninteractive");
        process::run_into(&mut command, log)
    };
    apt(&["update"])?;
    apt(&[&["install", "--yes", "--no-install-recommends", "--download-only"], &PACKAGES[..]].concat())?;
    let mut emulator = Command::new("apt-get");
    emulator.args(["download", "qemu-user-static"]).current_dir(state("emulator"));
    process::run_into(&mut emulator, log)?;
    for (packages, into) in [("cache/archives", "root"), ("emulator", "qemu")] {
        let files = std::fs::read_dir(state(packages)).map_err(|error| format!("{packages}: {error}"))?;
        let files = files.flatten().map(|file| file.path());
        for file in files.filter(|file| file.extension().is_some_and(|end| end == "deb")) {
            process::run_into(Command::new("dpkg").arg("-x").arg(&file).arg(folder.join(into)), log)?;
        }
    }
    Ok(())
}

impl ForeignPython {
    /// The interpreter, with its packages.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.qemu);
        command.arg("-L").arg(&self.root).arg(self.root.join(format!("usr/bin/python{VERSION}")));
        command.env("PYTHONPATH", &self.site);
        command
    }

    /// Installs a wheel, and what it needs, into an empty folder.
    pub fn install(&self, wheel: &Path, log: &Path) -> Result<(), String> {
        let folder = paths::target().join("xtask/aarch64/pip");
        let pip = install::new_python(&self.host, &folder, log)?;
        let _ = std::fs::remove_dir_all(&self.site);
        let mut install = Command::new(pip);
        install.args(["-m", "pip", "install", "--quiet", "--only-binary=:all:", "--python-version", VERSION]);
        for platform in ["manylinux2014_aarch64", "manylinux_2_27_aarch64", "manylinux_2_28_aarch64"] {
            install.args(["--platform", platform]);
        }
        process::run_into(install.arg("--target").arg(&self.site).arg(wheel), log)
    }
}
