//! The errors of this library.
//!
//! Every function that can fail returns [`Error`]: a chain of sentences for people, and at its root one
//! [`ErrorKind`] for programs.
//!
//! | enum | concern | a program distinguishes |
//! |---|---|---|
//! | [`FileError`] | reading and writing files | missing, unreadable, exists already, no place for an output |
//! | [`ArrayError`] | arrays of frames | not an array, damaged, unfit, too large |
//! | [`RecordingError`] | MCAP files | not a recording, not one of taxel, damaged, unsupported |
//! | [`SettingError`] | garments, scenes, scripts, calibrations, gestures | which parameter is invalid |
//! | [`RobotError`] | robots' descriptions, positions of joints | not a URDF, invalid link or joint, unknown link or joint, out of range |
//! | [`MapFileError`] | cognitive maps | unknown version, invalid value and its key, unknown concept |
//! | [`SourceError`] | sources and sessions | no board, busy, not permitted, several, silent, no board's wire, gone for good, refuses (and why) |
//! | [`LearnError`] | training and what it has trained | unfit data, not a base, unknown version, invalid model |
//! | [`UsageError`] | arguments of the caller | a name that does not exist, an argument out of range |
//!
//! There is one error type instead of one for each module, because a call crosses many of them: to open a
//! simulation reads a script, a garment, a scene and a map. With one type for each, a caller would unwrap
//! four layers, and each module would repeat the variants of those below it. Contexts ("in script pat") do
//! not change the kind. Where only a person can use what has happened, a variant holds the sentence.
//!
//! `{error}` prints the outermost sentence, `{error:#}` all of them, joined by `: `;
//! [`text::words::sentence`](crate::text::words::sentence) does so in plain words, for users.
//!
//! ```
//! use taxel::error::{ErrorKind, FileError};
//!
//! let Err(error) = taxel::open("replay:no/such.mcap") else { panic!("it does not exist") };
//! match error.kind() {
//!     ErrorKind::File(FileError::Missing { path, .. }) => assert!(path.ends_with("no/such.mcap")),
//!     other => panic!("{other}"),
//! }
//! assert!(format!("{error:#}").starts_with("no/such.mcap cannot be read: "));
//! ```

#[macro_use]
mod macros;

mod array;
mod chain;
mod context;
mod file;
mod kind;
mod learn;
mod map;
mod recording;
mod robot;
mod setting;
mod source;
mod usage;

pub use array::ArrayError;
pub use chain::{Error, Result};
pub(crate) use context::Context;
pub use file::FileError;
pub use kind::ErrorKind;
pub use learn::LearnError;
pub use map::MapFileError;
pub use recording::RecordingError;
pub use robot::RobotError;
pub use setting::SettingError;
pub use source::SourceError;
pub use usage::UsageError;
