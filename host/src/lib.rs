//! The host side of `taxel`, firmware and software for a robot's tactile garment: the program `taxel`, and
//! the library behind it.
//!
//! A board scans the garment, perceives touches, and sends frames, contacts and intentions. The host connects
//! to boards and configures them, shows, records and evaluates their streams, simulates boards, and trains
//! what they recognise. Perception itself is in the crate `taxel_core`, shared with the firmware.
//!
//! Begin with [`session`]: a [`session::Session`] opens any source and yields its events, and its example is
//! the shortest program that reads a board. [`client`] is the layer below it, without any I/O.
//!
//! In the order in which they build on each other; a module imports only modules before it:
//!
//! | module | holds |
//! |---|---|
//! | [`tell`] | errors in plain words and the exit status, steps and progress of long work |
//! | [`sim`] | the simulated garment and its scripts of touches |
//! | [`files`] | safe outputs, recorded frames, garments, scripts, calibrations |
//! | [`client`] | the host's end of the wire: bytes in, events out, with host times |
//! | [`recording`] | MCAP files: read, written and repaired |
//! | [`fcm`] | fuzzy cognitive maps: files, inference, explanation, learning |
//! | [`source`] | sources of bytes: simulation, USB, serial port, TCP, emulator, file, recording |
//! | [`session`] | the loop that connects a source and a client, reconnects, and restores settings |
//! | [`json`] | a stream's JSON |
//! | [`record`] | recordings of a stream and their topics |
//! | [`learn`] | training of what a board recognises |
//! | [`watch`], [`terminal`], [`view`], [`report`] | a followed board; display: in the terminal, in the browser, as a page |
//! | [`serve`], `foxglove` | the server behind the page and the one for Foxglove (feature `foxglove`) |
//! | [`mod@bench`] | tables and charts of cost and error |
//! | [`commands`], [`cli`] | the commands and the command line |
//!
//! Errors are `anyhow` errors of one sentence; [`tell::fault`] decides the exit status.
#![forbid(unsafe_code)]

// First: the modules below use its macros.
#[macro_use]
mod told;

pub mod tell;

pub mod sim;

pub mod files;

pub mod client;

pub mod recording;

pub mod fcm;

pub mod source;

pub mod session;

pub mod json;

pub mod record;

pub mod learn;

pub mod watch;

pub mod terminal;

pub mod report;

pub mod serve;

pub mod view;

#[cfg(feature = "foxglove")]
pub mod foxglove;

pub mod bench;

pub mod commands;

pub mod cli;
