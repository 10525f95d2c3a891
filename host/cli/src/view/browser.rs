//! Starts the user's browser.

use anyhow::{Context, Result};
use std::process::{Command, Stdio};

/// Opens an address in the system's default browser.
pub fn open(url: &str) -> Result<()> {
    let mut command = if cfg!(target_os = "windows") {
        // Not `start` of `cmd`, for which `&` in an address ends the command.
        let mut start = Command::new("rundll32");
        start.arg("url.dll,FileProtocolHandler");
        start
    } else if cfg!(target_os = "macos") {
        Command::new("open")
    } else {
        Command::new("xdg-open")
    };
    command.arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().map(drop).with_context(|| format!("no browser could be started; open {url} yourself"))
}
