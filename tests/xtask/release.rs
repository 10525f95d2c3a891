//! `cargo xtask release`: makes what is given away, in `dist/`: programs, Python packages, firmware, message
//! definitions, lists of what they are made of, checksums. No path, no moment and no user of this machine goes into it.

use crate::cross::{self, Toolchain};
use crate::{features, firmware, interpreter, pack, paths, process, supply, wheels};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Version of everything.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Systems of the program; the first one is that of the checks.
pub const TARGETS: [&str; 3] = [wheels::HERE, wheels::AARCH64, "x86_64-pc-windows-gnu"];
/// Systems for which only a machine of their own builds.
const MACOS: [&str; 2] = ["aarch64-apple-darwin", "x86_64-apple-darwin"];
/// Files that lie beside the program, from the repository.
const BESIDE: [&str; 5] = ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "examples"];
/// Options of the program's build, before its features. The wheel's package is selected, too, though not built: the
/// dependencies then have the features that the wheel needs, and are built once.
const PROGRAM: &str =
    "--package taxel-cli --package taxel-python --bin taxel --no-default-features --features";
/// Images of the firmware: the end of their name, and their features.
const IMAGES: [(&str, &[&str]); 2] = [("", &features::ALL), ("-contacts", &[])];

/// `cargo xtask release [--target TARGET]... [--out FOLDER]`, or `--compare FOLDER FOLDER`.
pub fn run(args: &[String]) -> Result<(), String> {
    let (mut out, mut targets) = (paths::root().join("dist"), Vec::new());
    let words: Vec<&str> = args.iter().map(String::as_str).collect();
    if let ["--compare", one, other] = words[..] {
        let absolute = |folder| std::path::absolute(folder).map_err(|error| format!("{folder}: {error}"));
        return process::run(pack::command("compare").args([absolute(one)?, absolute(other)?]));
    }
    for pair in words.chunks(2) {
        match pair {
            ["--target", target] if [&TARGETS[..], &MACOS].concat().contains(target) => targets.push(*target),
            ["--target", ..] => {
                let known = [&TARGETS[..], &MACOS].concat().join(", ");
                return Err(format!("--target takes one of: {known}"));
            }
            ["--out", folder] => {
                out = std::path::absolute(folder).map_err(|error| format!("{folder}: {error}"))?
            }
            _ => return Err(crate::USAGE.into()),
        }
    }
    if targets.is_empty() {
        targets.push(TARGETS[0]);
    }
    let release = Release::begin(out)?;
    for target in &targets {
        wheels::add_target(target, &release.log)?;
        release.program(target)?;
        release.wheel(target)?;
    }
    // What is the same for all systems is made on Linux.
    if targets.iter().any(|target| TARGETS.contains(target)) {
        let messages = paths::root().join("host/ros2/taxel_msgs");
        release.archive(&format!("taxel_msgs-{VERSION}.tar.gz"), &[messages])?;
        release.source()?;
        release.firmware()?;
    }
    release.pack("sums", [&release.out])
}

/// What all parts share.
struct Release {
    out: PathBuf,
    log: PathBuf,
    /// Interpreter with maturin, zig and cargo-zigbuild.
    tools: PathBuf,
    /// Licences of what is linked.
    licences: PathBuf,
    /// Time of the commit, s since 1970: that of every packed file.
    time: String,
}

impl Release {
    /// Writes what goes with several parts: the lists of dependencies, and their licences.
    fn begin(out: PathBuf) -> Result<Release, String> {
        std::fs::create_dir_all(&out).map_err(|error| format!("{}: {error}", out.display()))?;
        let python = interpreter::newest().ok_or("there is no python3.10 or later")?;
        let mut commit = Command::new("git");
        commit.args(["log", "-1", "--format=%ct"]).current_dir(paths::root());
        let time = std::env::var("SOURCE_DATE_EPOCH").ok().or_else(|| process::output(&mut commit));
        let release = Release {
            licences: out.join("THIRD-PARTY.txt"),
            out,
            log: paths::log("release")?,
            tools: wheels::tools(&python)?,
            time: time.ok_or("the time is neither in SOURCE_DATE_EPOCH nor that of a commit")?,
        };
        for given in &supply::GIVEN {
            let list = release.out.join(format!("{}-{VERSION}.cdx.json", given.package)).into();
            release.pack("sbom", given.words().into_iter().chain([list]))?;
        }
        let all = supply::GIVEN.iter().flat_map(supply::Given::words);
        release.pack("licences", [release.licences.clone().into()].into_iter().chain(all))?;
        Ok(release)
    }

    /// The program for a system, with its licences, packed.
    fn program(&self, target: &str) -> Result<(), String> {
        let mut build = if MACOS.contains(&target) {
            crate::cargo::cargo(&["build"], paths::root())
        } else {
            let mut zig = Command::new(wheels::folder().join("bin/cargo-zigbuild"));
            zig.arg("zigbuild");
            zig
        };
        let glibc = if target.contains("linux") { format!(".{}", wheels::GLIBC) } else { String::new() };
        build
            .args(["--release", "--locked", "--target", &format!("{target}{glibc}")])
            .args(PROGRAM.split(' '));
        build.arg([supply::FEATURES, "taxel-python/full"].join(",")).current_dir(paths::root());
        self.run(target, target, &mut build)?;
        let (program, end) =
            if target.contains("windows") { ("taxel.exe", "zip") } else { ("taxel", "tar.gz") };
        let built = paths::target().join(target).join("release").join(program);
        let beside = BESIDE.map(|file| paths::root().join(file));
        self.archive(
            &format!("taxel-{VERSION}-{target}.{end}"),
            &[&[built, self.licences.clone()], &beside[..]].concat(),
        )
    }

    /// The wheel for a system.
    fn wheel(&self, target: &str) -> Result<(), String> {
        let wheel = wheels::maturin(&self.tools, "build", &wheels::options(target), target, |build| {
            self.run(&format!("wheel for {target}"), target, build)
        })?;
        self.pack("wheel", [&wheel, &self.licences, &self.out])
    }

    /// The source distribution.
    fn source(&self) -> Result<(), String> {
        let source = wheels::maturin(&self.tools, "sdist", &[], "source", |make| {
            self.run("source distribution", "", make)
        })?;
        self.copy(&source, &source.file_name().unwrap_or_default().to_string_lossy())
    }

    /// The images: for the boot loader, and for debug probes.
    fn firmware(&self) -> Result<(), String> {
        let toolchain = Toolchain::find()?;
        for (end, features) in IMAGES {
            let folder = toolchain.folder().join("given");
            let mut build = features::image(&toolchain, features);
            let flags = [&[cross::FLAGS.to_string()], &remapped(&toolchain.rustc())?[..]].concat();
            build.env("CARGO_TARGET_DIR", &folder).env(cross::FLAGS_VARIABLE, flags.join(" "));
            process::run_into(&mut build, &self.log)?;
            let elf = folder.join(cross::TARGET).join("release/taxel-firmware");
            self.copy(&elf, &format!("taxel-firmware{end}-{VERSION}.elf"))?;
            self.copy(&firmware::to_uf2(&elf)?, &format!("taxel-firmware{end}-{VERSION}.uf2"))?;
        }
        Ok(())
    }

    /// Runs a build for a target so that its product does not depend on the folder and the moment.
    fn run(&self, what: &str, target: &str, build: &mut Command) -> Result<(), String> {
        let start = Instant::now();
        // Of programs and wheels alike, which share what is built of their dependencies.
        build.envs(wheels::linker(target)?).env("CARGO_PROFILE_RELEASE_STRIP", "symbols");
        build.env("CARGO_ENCODED_RUSTFLAGS", remapped("rustc".as_ref())?.join("\x1f"));
        build.env("SOURCE_DATE_EPOCH", &self.time).env("CARGO_INCREMENTAL", "0");
        // Where zig is found.
        build.env("PATH", process::path_with(&wheels::folder())?);
        process::run_into(build, &self.log).map_err(|why| format!("{why}, see {}", self.log.display()))?;
        println!("{what}: {} s", start.elapsed().as_secs());
        Ok(())
    }

    fn archive(&self, name: &str, files: &[PathBuf]) -> Result<(), String> {
        self.pack("archive", [&self.out.join(name)].into_iter().chain(files))
    }

    fn pack(&self, task: &str, words: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Result<(), String> {
        process::run(pack::command(task).args(words).env("SOURCE_DATE_EPOCH", &self.time))
    }

    fn copy(&self, from: &Path, name: &str) -> Result<(), String> {
        let copied = std::fs::copy(from, self.out.join(name));
        copied.map(|_| ()).map_err(|error| format!("{}: {error}", from.display()))
    }
}

/// Options by which a compiler writes no path of this machine into what it makes.
fn remapped(rustc: &Path) -> Result<[String; 3], String> {
    let asked = |args: &[&str]| {
        process::output(Command::new(rustc).args(args)).ok_or(format!("{} does not answer", rustc.display()))
    };
    let (root, version) = (asked(&["--print", "sysroot"])?, asked(&["-vV"])?);
    let commit = version.lines().find_map(|line| line.strip_prefix("commit-hash: ")).unwrap_or("unknown");
    let cargo = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo =
        cargo.or_else(|| Some(std::env::home_dir()?.join(".cargo"))).ok_or("there is no home folder")?;
    let map = |from: &Path, to: &str| format!("--remap-path-prefix={}={to}", from.display());
    Ok([
        map(&paths::root(), "/taxel"),
        map(&cargo, "/cargo"),
        map(&Path::new(&root).join("lib/rustlib/src/rust"), &format!("/rustc/{commit}")),
    ])
}
