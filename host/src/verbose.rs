//! What the program does step by step, told on the standard error where `-v` asks for it.

use std::fmt::Display;
use std::sync::atomic::{AtomicBool, Ordering};

static ON: AtomicBool = AtomicBool::new(false);

/// Tells from now on.
pub fn on() {
    ON.store(true, Ordering::Relaxed);
}

/// Tells a step: `garment block-4x16 sent`.
pub fn tell(step: impl Display) {
    if ON.load(Ordering::Relaxed) {
        eprintln!("taxel: {step}");
    }
}
