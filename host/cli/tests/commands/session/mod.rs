//! Boards that are recorded for long, and that break while they are watched and recorded.

// What else it can do, the tests of the library use.
mod day;
mod memory;
#[allow(dead_code)]
#[path = "../../../../taxel/tests/library/session/rig.rs"]
mod rig;
#[cfg(unix)]
mod soak;
mod watched;
