//! Clock of this machine: the system's, or in WebAssembly that of the page, which has to set it (`set_page_clock`).
//!
//! Everything of this crate that reads a clock or sleeps does so here. In WebAssembly nothing sleeps: whoever calls does so
//! again later.

#[cfg(target_family = "wasm")]
mod page_clock;

#[cfg(not(target_family = "wasm"))]
pub use std::{thread::sleep, time::Instant};

#[cfg(target_family = "wasm")]
pub use page_clock::{Instant, calendar, set_page_clock, sleep};

/// Time since the beginning of 1970; 0 if the calendar is set to before.
#[cfg(not(target_family = "wasm"))]
pub fn calendar() -> std::time::Duration {
    use std::time::SystemTime;
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default()
}
