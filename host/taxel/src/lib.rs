//! The host side of `taxel`, firmware and software for a robot's tactile garment: the library behind the
//! program `taxel`.
//!
//! A board scans the garment, perceives touches, and sends frames, contacts and intentions. The host connects
//! to boards and configures them, shows, records and evaluates their streams, simulates boards, and trains
//! what they recognise. Perception itself is in the crate `taxel_core`, shared with the firmware.
//!
//! Begin with [`open`]: it opens any source, and yields its events. [`client`] is the layer below it, without
//! any I/O.
//!
//! In the order in which they build on each other; a module imports only modules before it:
//!
//! | module | holds |
//! |---|---|
//! | [`error`] | what fails, by concern, for programs and for people |
//! | [`time`] | the clock of this machine, or of the page in WebAssembly |
//! | [`text`] | errors in plain words, steps and progress of long work |
//! | [`sim`] | the simulated garment and its scripts of touches |
//! | [`files`] | safe outputs, recorded frames, garments, scripts, calibrations |
//! | [`body`] | the garment on the robot: where each taxel lies, forces by link |
//! | [`client`] | the host's end of the wire: bytes in, events out, with host times |
//! | [`recording`] | MCAP files: read, written and repaired |
//! | [`fcm`] | fuzzy cognitive maps: files, inference, explanation, learning |
//! | [`network`] | boards between machines: names, order, configuration |
//! | [`source`] | sources of bytes: simulation, USB, serial port, TCP, Zenoh, recording |
//! | [`session`] | the loop that connects a source and a client, reconnects, and restores settings |
//! | [`virtual_board`] | a board's own code, stepped by hand with codes and a time |
//! | [`json`] | a stream's JSON |
//! | `offer` | a board, offered to other machines over Zenoh (feature `zenoh`) |
//! | [`moments`] | moments, NMI and axis of one image |
//! | [`ros2`] | messages of ROS 2 and their layout |
//! | [`record`] | recordings of a stream and their topics |
//! | [`robot`] | a robot of several boards: its file, and all their streams as one |
//! | [`mind`] | what touches mean to a robot of several boards |
//! | [`motion`] | from touch to motion: velocities of the robot's joints |
//! | [`learn`] | training of what a board recognises |
//!
//! Every error is an [`Error`]: sentences for people, and a [kind](Error::kind) that a program can match:
//!
//! ```
//! use taxel::error::{ErrorKind, SourceError, UsageError};
//!
//! fn advice(source: &str) -> &'static str {
//!     let Err(error) = taxel::open(source) else { return "it streams" };
//!     match error.kind() {
//!         ErrorKind::Source(SourceError::NoBoard(_)) => "plug it in",
//!         ErrorKind::Usage(UsageError::Unknown(_)) => "correct the name",
//!         _ => "read what it says",
//!     }
//! }
//! assert_eq!(advice("sim:pat"), "it streams");
//! assert_eq!(advice("serial:/dev/none"), "plug it in");
//! assert_eq!(advice("sim:pit"), "correct the name");
//! ```
#![forbid(unsafe_code)]

#[macro_use]
pub mod error;

pub mod time;

pub mod text;

/// The simulated garment and its scripts of touches.
pub use taxel_sim as sim;

pub mod files;

pub mod body;

pub mod client;

pub mod recording;

pub mod fcm;

pub mod network;

pub mod source;

pub mod session;

pub mod virtual_board;

pub mod json;

#[cfg(feature = "zenoh")]
pub mod offer;

pub mod moments;

pub mod ros2;

pub mod record;

pub mod robot;

pub mod mind;

pub mod motion;

pub mod learn;

use session::Session;

pub use error::{Error, Result};
/// The core, whose types messages, garments and scenes have.
pub use taxel_core;

/// Opens a source by its name: a board (`auto`, `usb`, `serial:PATH`, `tcp:HOST:PORT`), a simulated one
/// (`sim:pat`), a file or a recording (`replay:touch.mcap`).
///
/// ```
/// use taxel::client::Event;
///
/// let events = taxel::open("sim:pat")?;
/// let contacts = events.filter(|event| matches!(event, Ok(Event::Contacts { .. })));
/// assert_eq!(contacts.take(3).count(), 3);
/// # Ok::<(), taxel::Error>(())
/// ```
pub fn open(source: &str) -> Result<Session> {
    Session::open(source)
}
