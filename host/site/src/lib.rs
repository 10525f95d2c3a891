//! The page of `taxel view` without a program: what the program would tell the page, a worker of the page itself tells it,
//! from a simulated board or from one that the page has opened by Web Serial.
//!
//! `cargo xtask site` makes the folder of the site. The worker (`page/worker.js`) calls the functions of [`exports`]; all
//! of them pass numbers alone, and texts and bytes by two buffers:
//!
//! | file | holds |
//! |---|---|
//! | `exports.rs` | the functions that the worker calls |
//! | `worker.rs` | [`Worker`]: a board, what follows it, and the messages to the page |
//! | `serial.rs` | [`SerialPipe`]: a port whose bytes the page carries |
//! | `lines.rs` | a board's stream as lines of JSON, as `taxel live --json` prints them |
#![deny(unsafe_code)]

pub mod exports;
mod lines;
mod serial;
mod worker;

pub use lines::{lines, lines_of};
pub use serial::SerialPipe;
pub use worker::{Opening, Worker};
