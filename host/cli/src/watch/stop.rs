//! Ctrl-C, for commands that have to restore something before they end.

use anyhow::{Result, anyhow, bail};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on [`asked`] and [`check`] report Ctrl-C; a second one ends the program at once.
pub fn catch() -> Result<()> {
    static CAUGHT: OnceLock<Result<(), ctrlc::Error>> = OnceLock::new();
    let noted = || {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    };
    let caught = CAUGHT.get_or_init(|| ctrlc::set_handler(noted)).as_ref();
    caught.copied().map_err(|error| anyhow!("Ctrl-C cannot be caught: {error}"))
}

/// True if Ctrl-C was pressed.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Errors if Ctrl-C was pressed.
pub fn check() -> Result<()> {
    if asked() {
        bail!("ended by Ctrl-C");
    }
    Ok(())
}
