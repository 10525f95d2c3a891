//! The program `taxel`: the command line, the commands, and what shows a stream.
//!
//! This crate is no library: its modules are public for its tests and for the fuzzer. Programs use the crate
//! [`taxel`].
//!
//! Without the feature `program` only that is there of which a page is made, in WebAssembly, too: `fault`, `palette`,
//! `watch`, `folding`, `on_robot`, `view`, and of these what listens to no network.
//!
//! In the order in which they build on each other; a module imports only modules before it:
//!
//! | module | holds |
//! |---|---|
//! | [`fault`] | who is to blame for an error, and the exit status |
//! | `stderr_log` | what the library logs, on standard error |
//! | [`palette`] | colours and scale of pressure, for all that shows it |
//! | [`watch`] | a followed board: options, loop, sentences about events |
//! | [`terminal`] | views in the terminal |
//! | [`folding`] | where the garment folds, for what shows it |
//! | [`on_robot`] | the robot that carries the garment, for what shows it |
//! | [`report`] | a recording or a board on one page |
//! | [`serve`] | the door of a server on this machine |
//! | [`view`] | the page in the browser, and its server |
//! | `foxglove` | the server for Foxglove (feature `foxglove`) |
//! | `ros2` | the ROS 2 node (feature `ros2`) |
//! | `commands` | the commands |
//! | [`cli`] | the command line |
//! | [`program`] | the program from its arguments to its exit status |
#![forbid(unsafe_code)]

// First: the modules below use its macros.
#[cfg(feature = "program")]
#[macro_use]
mod stderr;

pub mod fault;

#[cfg(feature = "program")]
mod stderr_log;

pub mod palette;

pub mod watch;

#[cfg(feature = "program")]
pub mod terminal;

pub mod folding;

pub mod on_robot;

#[cfg(feature = "program")]
pub mod report;

#[cfg(feature = "program")]
pub mod serve;

pub mod view;

#[cfg(feature = "foxglove")]
pub mod foxglove;

#[cfg(feature = "ros2")]
pub mod ros2;

#[cfg(feature = "program")]
#[doc(hidden)]
pub mod commands;

#[cfg(feature = "program")]
pub mod cli;

#[cfg(feature = "program")]
pub mod program;

/// The error of commands and views.
pub use anyhow::Error;
