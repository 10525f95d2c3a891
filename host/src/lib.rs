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
//! In the order of the data:
//!
//! | modules | hold |
//! |---|---|
//! | [`words`], [`fault`], [`verbose`], [`progress`] | errors in plain words, exit status, steps and progress of long work |
//! | [`output`], [`arrays`] | safe output files; recorded frames |
//! | [`garments`], [`sim`], [`scripts`] | garment files; the simulated garment, and its scripts of touches |
//! | [`client`], [`clock`] | the host's end of the wire: bytes in, events out, with host times |
//! | [`recording`] | MCAP files: read, written and repaired |
//! | [`fcm`] | fuzzy cognitive maps: files, inference, explanation, learning |
//! | [`source`] | sources of bytes: simulation, USB, serial port, TCP, emulator, file, recording |
//! | [`session`] | the loop that connects a source and a client, reconnects, and restores settings |
//! | [`calibrate`], [`json`], [`record`] | forces; a stream's JSON; its recorder and its topics |
//! | [`shapes`], [`touches`], [`learn`], [`doubts`] | training of what a board recognises |
//! | [`watch`], [`terminal`], [`view`], [`report`] | a followed board; display: in the terminal, in the browser, as a page |
//! | [`serve`], `foxglove` | the server behind the page and the one for Foxglove (feature `foxglove`) |
//! | [`mod@bench`] | tables and charts of cost and error |
//! | [`commands`], [`cli`] | the commands and the command line |
//!
//! Errors are `anyhow` errors of one sentence; [`fault`] decides the exit status.
#![forbid(unsafe_code)]

// First: the modules below use its macros.
#[macro_use]
mod told;

pub mod arrays;
pub mod bench;
pub mod calibrate;
pub mod cli;
pub mod client;
pub mod clock;
pub mod commands;
pub mod date;
pub mod doubts;
pub mod fault;
pub mod fcm;
#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod garments;
pub mod growths;
pub mod json;
pub mod learn;
pub mod output;
mod passed;
pub mod progress;
pub mod record;
pub mod recording;
pub mod report;
pub mod scripts;
pub mod serve;
pub mod session;
pub mod shapes;
mod shared;
pub mod sim;
pub mod source;
mod starts;
pub mod terminal;
pub mod toml_key;
pub mod touches;
pub mod verbose;
pub mod view;
pub mod watch;
pub mod words;
