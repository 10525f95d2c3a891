//! What the program does step by step, told on the standard error where `-v` asks for it.

use crate::words;
use std::fmt::Display;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

static ON: AtomicBool = AtomicBool::new(false);

/// Tells from now on.
pub fn on() {
    ON.store(true, Ordering::Relaxed);
}

/// Whether somebody wants to be told.
pub fn is_on() -> bool {
    ON.load(Ordering::Relaxed)
}

/// Tells a step: `garment block-4x16 sent`.
pub fn tell(step: impl Display) {
    if ON.load(Ordering::Relaxed) {
        // Steps quote boards and files.
        eprintln!("taxel: {}", words::printable(&step.to_string()));
    }
}

/// Tells that a file is about to be read.
pub fn reads(file: impl AsRef<Path>) {
    tell(format_args!("reads {}", file.as_ref().display()));
}
