//! Steps of the program, printed to standard error with `-v`.

use super::words;
use std::fmt::Display;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

static ON: AtomicBool = AtomicBool::new(false);

/// Turns the output on.
pub fn on() {
    ON.store(true, Ordering::Relaxed);
}

/// True if the output is on.
pub fn is_on() -> bool {
    ON.load(Ordering::Relaxed)
}

/// Prints a step: `garment block-4x16 sent`.
pub fn print(step: impl Display) {
    if ON.load(Ordering::Relaxed) {
        // Steps quote boards and files.
        eprintln!("taxel: {}", words::printable(&step.to_string()));
    }
}

/// Prints that a file is about to be read.
pub fn reads(file: impl AsRef<Path>) {
    print(format_args!("reads {}", file.as_ref().display()));
}
