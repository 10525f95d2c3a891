//! Tactile arrays of others: what comes over their wire, and the frames in it.
//!
//! An [`ArrayDescription`] says how a stream is cut into frames: marked bytes, answers to a request, lines of numbers,
//! rows with empty lines between, or counted zeros. An [`ArrayDecoder`] delivers the frames, the same however the
//! stream comes in pieces. Nothing is repaired: a damaged frame is dropped and counted.

mod answers;
mod checksum;
mod codes;
mod datagrams;
mod decoder;
mod description;
mod form;
mod formats;
mod frame;
mod input;
mod link;
mod listener;
mod marked;
mod noise;
mod number;
mod open;
mod order;
mod original;
mod pace;
mod perceiver;
mod piped;
mod polling;
mod recognise;
mod report;
mod rows;
mod sensor;
mod spec;
mod stamp;
mod timed_bytes;
mod wiresens;
mod words;
mod zeros;

pub use codes::CodeMap;
pub use decoder::{ArrayDecoder, FrameSink};
pub use description::{ArrayDescription, ArrayLinkSettings};
pub use frame::{ArrayFrame, ArrayLoss};
pub use link::ArrayLink;
pub use noise::{ArrayNoise, NoiseMeter};
pub use open::open;
pub use original::{ORIGINAL, OriginalBytes};
pub(crate) use recognise::{KnownArray, numbers};
pub use sensor::described;
pub use spec::ArraySpec;
