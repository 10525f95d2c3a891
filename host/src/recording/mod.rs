//! A recording: one [MCAP](https://mcap.dev/spec) file, which Foxglove, Rerun, Python's `mcap` and ROS 2 read.
//!
//! The records are those of the crate `mcap`; they are put together here, and not by its writer, for three
//! reasons: a chunk is written whole or not at all, so that a kill or a full disk leaves nothing half in the
//! middle; a damaged file can be read as far as it is sound; and chunks are compressed (LZ4) without a C
//! library.
//!
//! | file | holds |
//! |---|---|
//! | `store.rs` | what is written to: a file, which can be cut back |
//! | `append.rs` | one record as bytes |
//! | `chunk.rs` | messages of a second, compressed, with their index |
//! | `contents.rs` | what is in a file |
//! | `ending.rs` | the end of a file: its summary and its footer |
//! | `writer.rs` | a file being written |
//! | `written.rs` | the chunks of such a file, found again for its end |
//! | `records.rs` | the records of a file, one after the other |
//! | `messages.rs` | its messages |
//! | `damage.rs` | what is damaged in the middle of a file, passed over |
//! | `texts.rs` | one record, read once its texts are known to lie within it |
//! | `lz4.rs` | LZ4 frames, decoded without a copy |
//! | `source.rs` | bytes of a file at any place |
//! | `summary.rs` | the end of a file: footer and summary, read |
//! | `clips.rs` | the messages of any chunk |
//! | `overview.rs` | what is in a file, by its summary or by going through it |
//! | `attached.rs` | one attached file |
//! | `salvage/` | the records of a file that may be damaged |
//! | `scan.rs`, `found.rs` | what is in a file, found by going through it |
//! | `repair.rs` | a file that is damaged or has no end, written anew |

mod append;
mod attached;
mod chunk;
mod clips;
mod contents;
mod damage;
mod ending;
mod found;
mod lz4;
mod messages;
mod overview;
mod records;
mod repair;
mod salvage;
mod scan;
mod source;
mod store;
mod summary;
mod texts;
mod writer;
mod written;

#[cfg(test)]
mod tests;

pub use clips::{Clips, Piece, Place};
pub use contents::{ChannelInfo, Contents, Stretch};
pub use damage::Skipped;
pub use messages::{Message, Messages};
pub use overview::Overview;
pub use records::{Head, Inside, RawRecord, Records};
pub use repair::repair;
pub use salvage::Damage;
pub use scan::{Scan, scan};
pub use store::Store;
pub use summary::{Summary, chunk_indexes, footer, summary};
pub use writer::{Format, Writer};
