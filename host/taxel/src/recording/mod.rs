//! Recordings: [MCAP](https://mcap.dev/spec) files, as read by Foxglove, Rerun, Python's `mcap` and ROS 2.
//!
//! The records are those of the crate `mcap`. Its writer is not used, for three reasons: here a chunk is
//! written whole or not at all, so that a kill or a full disk leaves nothing partial in the middle; a damaged
//! file can be read as far as it is intact; and chunks are compressed (LZ4) without a C library.
//!
//! | file | holds |
//! |---|---|
//! | `library.rs` | the name in a file's header, and the wire of its frames |
//! | `store.rs` | what a recording is written to: a file that can be truncated |
//! | `append.rs` | one record as bytes |
//! | `chunk.rs` | messages of a second, compressed, with their index |
//! | `filler.rs` | messages of some channels, filling chunks |
//! | `contents.rs` | contents of a file |
//! | `ending.rs` | the end of a file, written: its summary and its footer |
//! | `writer.rs` | a file being written |
//! | `written.rs` | the chunks of such a file, read back for its end |
//! | `records.rs` | the records of a file, one after the other |
//! | `messages.rs` | its messages |
//! | `damage.rs` | damage in the middle of a file, skipped |
//! | `texts.rs` | one record, parsed once its texts are known to lie within it |
//! | `lz4.rs` | LZ4 frames, written block by block and decoded without a copy |
//! | `source.rs` | bytes of a file at any offset |
//! | `summary.rs` | the end of a file, read: footer and summary |
//! | `clips.rs` | the messages of any chunk |
//! | `force_scale.rs` | scale of forces of a recorded board |
//! | `overview.rs` | contents of a file, by its summary or a scan |
//! | `attached.rs` | one attachment |
//! | `salvage/` | the records of a file that may be damaged |
//! | `scan.rs`, `found.rs` | contents of a file, by a scan |
//! | `board_names.rs` | names of what a recording holds of one board of a robot |
//! | `board_recording.rs` | a file of one board, or a board of a robot's file |
//! | `wire_reader.rs` | the frames of the wire of a board, and the gaps between them |
//! | `gap_mark.rs` | begin and end of such a gap |
//! | `renumber.rs` | numbers of the messages in such frames |
//! | `repair.rs` | rewrites a damaged or truncated file |

mod append;
mod attached;
mod board_names;
mod board_recording;
mod chunk;
mod clips;
mod contents;
mod damage;
mod ending;
mod filler;
mod force_scale;
mod found;
mod gap_mark;
mod library;
mod lz4;
mod messages;
mod overview;
mod records;
mod renumber;
mod repair;
mod salvage;
mod scan;
mod source;
mod store;
mod summary;
mod texts;
mod wire_reader;
mod writer;
mod written;

#[cfg(test)]
mod tests;

pub(crate) use board_names::attachment_of;
pub use board_names::{WIRE, boards, of_board};
pub use board_recording::BoardRecording;
pub(crate) use board_recording::is_board;
pub use chunk::FullChunk;
pub use clips::{ChunkPlace, ClipMessage, Clips};
pub use contents::{ChannelInfo, Contents, Stretch};
pub use damage::Skipped;
pub use filler::Filler;
pub use force_scale::{CALIBRATION, calibration, force_scale};
pub use gap_mark::{GapMark, gap_marks};
pub use messages::{Message, Messages};
pub use overview::Overview;
pub use records::{Head, Inside, RawRecord, Records};
pub use renumber::{lost, renumbered, sequence};
pub use repair::repair;
pub use salvage::Unreadable;
pub use scan::{Scan, scan};
pub use store::Store;
pub use summary::{Summary, chunk_indexes, footer, summary};
pub use wire_reader::{HELLO, LinkRecord, WireReader};
pub use writer::{Format, Writer};
