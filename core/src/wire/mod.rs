//! The wire: messages between board and host, and the frames that carry them.
//!
//! A frame is `COBS(postcard(message) ++ CRC) ++ 0x00`, where CRC is CRC-32/ISO-HDLC of the postcard bytes,
//! little-endian. A message from the board is `(seq, report)`, one to the board is a [`Request`]. `seq` (u32,
//! wraps) counts the messages handed to the link: a gap is a loss. `frame` (u32) counts scans: a gap without
//! a gap in `seq` is thinning.
//!
//! Variants are only appended, and fields of a shipped variant never change. postcard writes a variant's
//! number and every unsigned integer as a varint (7 bits a byte, low first), signed ones zigzag, sequences
//! and strings with their length before them, an option as 0 or 1 and its value.
//!
//! | number | report | when |
//! |--:|---|---|
//! | 0 | [`Hello`] | at start, each second until `Start`, in answer to `Start` |
//! | 1 | [`Frame`] | at the scene's rate, when the link has room |
//! | 2 | [`ContactList`] | at the scene's rate; onsets and releases always |
//! | 3 | [`SymbolList`] | when there is an event; a state per touched region |
//! | 4 | [`IntentReport`] | with each inference; changes of the leading intention always |
//! | 5 | [`ReactionReport`] | always |
//! | 6 | [`Health`] | each second |
//! | 7 | [`Log`] | when something is wrong |
//! | 8 | [`SyncReport`] | in answer to `Sync` |
//! | 9 | [`Answer`] | in answer to every other request |
//! | 10 | [`Raw`] | at the scene's rate, when the link has room |
//! | 11 | [`Budget`] | each second, or at the requested rate |
//! | 12 | [`HealthMap`] | in answer to `Start`, and when it changes; in as many parts as needed |
//! | 13 | [`Temperature`] | each second, from a board with a thermometer |
//! | 14 | [`SelfTestReport`] | in answer to `Start` if there was one; before the answer to each `SelfTest` |
//! | 15 | [`GestureReport`] | after `SetGestures`: with each announced class, and at the end of a touch |
//! | 16 | [`ShapesReport`] | when a gallery was taught or dropped; in answer to `Start` if one is in force |
//! | 17 | [`ReflexReport`] | with the `Reaction` that began by reflex; always |
//! | 18 | [`ConfidenceReport`] | before each [`GestureReport`] whose model gives a confidence; always |
//! | 19 | [`Boot`](crate::boot::Boot) | after each `Hello`, from a board that knows the cause of its reset |
//! | 20 | [`UnsureReport`] | when a contact becomes unsure or sure; the newest state |
//! | 21 | [`FormsReport`] | if requested: before a `Contacts` in which a form is older than its frame |
//! | 22 | [`PressingReport`] | if requested: at that rate while something touches, when the link has room |
//! | 23 | [`FoldsReport`] | ten times per second while a table of folds is in force, when the link has room |
//! | 24 | [`BoundsReport`] | before a `Pressing` of which something is unknown |
//! | 25 | [`RegionsReport`] | when a region of the surface changes, and each second |
//! | 26 | [`RegionNames`] | before the first `Regions` after a `Start` or of another surface |
//! | 27 | [`StartOfFrame`] | after each answer to `Sync`, from a board on USB |
//!
//! A link carries nothing but these bytes. A board with several links uses one at a time, by whole messages:
//! USB while a program there has opened its port, else the UART.
//!
//! The body of a [`Frame`] is the conditioned image (before fold; background zero), lossless, see
//! [`encode_image`]: alone if `base` is none, else the difference to the frame of that number, which is the
//! last `Frame` before it. `Raw` has this code, too, always alone.

mod cobs;
mod codec;
mod each;
mod error;
mod image_decode;
mod image_encode;
mod receiver;
mod report;
mod request;
mod writer;

pub use codec::{Checksum, decode, encode, frame_bound, open};
pub(crate) use codec::{close, lead, put};
pub(crate) use each::Each;
pub use error::WireError;
pub use image_decode::{ImageError, ImageFault, decode_image, image_bound, image_sum};
pub(crate) use image_encode::ImageReference;
pub use image_encode::encode_image;
pub use receiver::Receiver;
pub use report::*;
pub use request::*;
pub(crate) use writer::write;
