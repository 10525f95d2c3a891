//! Where things lie.

use std::path::{Path, PathBuf};

/// The repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the repository").to_path_buf()
}

/// The firmware's package.
pub fn firmware() -> PathBuf {
    root().join("firmware")
}

/// The emulator harness.
pub fn emulator() -> PathBuf {
    root().join("tests/emulator")
}

/// What drives the page of `taxel view` in a browser.
pub fn browser() -> PathBuf {
    root().join("tests/browser")
}

/// Cargo's target folder.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// The folder of everything that is built for the microcontroller, a folder a way (see `cross`).
pub fn cross_target() -> PathBuf {
    target().join("firmware")
}
