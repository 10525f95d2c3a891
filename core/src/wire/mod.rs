//! The wire: messages between board and host, and the frames that carry them.
//!
//! A frame is `COBS(postcard(message) ++ CRC) ++ 0x00`, where CRC is CRC-32/ISO-HDLC of the postcard bytes,
//! little-endian. A message from the board is `(seq, report)`, one to the board is a [`Request`]. `seq` (u32,
//! wraps) counts the messages handed to the link: a gap is a loss. `frame` (u32) counts scans: a gap without
//! a gap in `seq` is thinning.
//!
//! A message ends with its frame, and a later version adds fields at its end: whoever does not know them passes
//! them over, whoever misses them takes them as 0, none or empty. So lists at the end of a report may be left
//! out if they are empty. What is added of each element of a list is a list of its own. A message of an unknown
//! number is passed over, too. Only what cannot be said in this way needs another [`PROTOCOL`], which each
//! [`Hello`] begins with, whatever follows. postcard writes a variant's
//! number and every unsigned integer as a varint (7 bits a byte, low first), signed ones zigzag, sequences
//! and strings with their length before them, an option as 0 or 1 and its value.
//!
//! [`Report`] and [`Request`] are tables of all messages. The number of a report is its urgency, too: of what
//! waits for the link, the lowest number is encoded first, from what the board knows then. So what is thinned
//! on a slow link is what comes last: images, then states, whose newest one is sent. Answers, onsets, ends,
//! reactions and changes of an intention are never thinned.
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
mod rest;
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
