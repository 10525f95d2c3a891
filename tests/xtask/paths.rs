//! Paths of the repository and of build products.

use std::path::{Path, PathBuf};

/// The repository: the one in which cargo runs this program, also if it was built in another place.
pub fn root() -> PathBuf {
    let tests = std::env::var_os("CARGO_MANIFEST_DIR");
    let tests = tests.map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).into(), PathBuf::from);
    tests.parent().expect("tests/ lies in the repository").to_path_buf()
}

/// The firmware's package.
pub fn firmware() -> PathBuf {
    root().join("firmware")
}

/// The fuzz targets.
pub fn fuzz() -> PathBuf {
    root().join("fuzz")
}

/// The emulator harness.
pub fn emulator() -> PathBuf {
    root().join("tests/emulator")
}

/// The browser tests of the page of `taxel view`.
pub fn browser() -> PathBuf {
    root().join("tests/browser")
}

/// Cargo's target folder.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// Target folder for the microcontroller, with a folder for each toolchain (see `cross`).
pub fn cross_target() -> PathBuf {
    target().join("firmware")
}

/// Log of a run, emptied.
pub fn log(name: &str) -> Result<PathBuf, String> {
    let folder = target().join("xtask");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let log = folder.join(format!("{name}.log"));
    let _ = std::fs::remove_file(&log);
    Ok(log)
}
