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
//! | [`sim`] | the simulated board: scripts of touches on a simulated garment |
//! | [`source`] | sources of bytes: simulation, USB, serial port, TCP, emulator, file, recording |
//! | [`client`], [`clock`] | the host's end of the wire: bytes in, events out, with host times |
//! | [`session`] | the loop that connects a source and a client, reconnects, and restores settings |
//! | [`garments`], [`config`], [`scenes`] | garment and scene files, and scripts of touches |
//! | [`watch`], [`terminal`], [`view`], [`report`] | a followed board; display: in the terminal, in the browser, as a page |
//! | [`serve`], `foxglove` | the server behind the page and the one for Foxglove (feature `foxglove`) |
//! | [`recording`] | recordings: MCAP files, read, written and repaired |
//! | [`record`], [`replay`], [`info`], [`repair`], [`export`] | commands about recordings; their topics |
//! | [`setup`], [`settle`], [`calibrate`], [`raw`] | from raw codes: wiring, settling time, forces |
//! | [`health`], [`doctor`] | faulty taxels, lines and boards |
//! | [`flash`], [`ports`], [`save`], [`reset_settings`] | commands about a board itself |
//! | [`arrays`], [`process`], [`features`], [`doubts`] | recorded frames, run through the board's pipeline |
//! | [`fcm`] | fuzzy cognitive maps: files, inference, explanation, learning |
//! | [`shapes`], [`touches`], [`gestures`], [`intent`], [`learn`] | training of what a board recognises |
//! | [`mod@bench`] | tables and charts of cost and error |
//! | [`output`], [`words`], [`fault`], [`progress`] | safe output files; errors in plain words; exit status |
//! | [`cli`] | the command line |
//!
//! Each command is a module with its arguments and a function `run`. Errors are `anyhow` errors of one
//! sentence; [`fault`] decides the exit status.
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
pub mod config;
pub mod date;
pub mod doctor;
pub mod doubts;
pub mod export;
pub mod fault;
pub mod fcm;
pub mod features;
pub mod flash;
#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod garments;
pub mod gestures;
pub mod growths;
pub mod health;
pub mod info;
pub mod intent;
pub mod json;
pub mod learn;
pub mod output;
mod passed;
pub mod ports;
pub mod process;
pub mod progress;
pub mod raw;
pub mod record;
pub mod recording;
pub mod repair;
pub mod replay;
pub mod report;
pub mod reset_settings;
pub mod save;
pub mod scenes;
pub mod scripts;
pub mod serve;
pub mod session;
pub mod settle;
pub mod setup;
pub mod shapes;
mod shared;
pub mod sim;
pub mod source;
mod starts;
pub mod stop;
pub mod terminal;
pub mod toml_key;
pub mod touches;
pub mod verbose;
pub mod view;
pub mod watch;
pub mod words;
