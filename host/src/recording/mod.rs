//! A recording: one [MCAP](https://mcap.dev/spec) file, which Foxglove, Rerun, Python's `mcap` and ROS 2 read.
//!
//! The records are those of the crate `mcap`; they are put together here, and not by its writer, for three reasons: a chunk is
//! written whole or not at all, so that a kill or a full disk leaves nothing half in the middle; a file whose end is missing
//! is completed where it lies, without a copy; and chunks are compressed (LZ4) without a C library.
//!
//! | file | holds |
//! |---|---|
//! | `store.rs` | what is written to: a file, which can be cut back |
//! | `append.rs` | one record as bytes |
//! | `chunk.rs` | messages of a second, compressed, with their index |
//! | `contents.rs` | what is in a file: the summary at its end |
//! | `writer.rs` | a file being written |
//! | `records.rs` | the records of a file, one after the other |
//! | `messages.rs` | its messages |
//! | `damage.rs` | what is damaged in the middle of a file, passed over |
//! | `lz4.rs` | LZ4 frames, decoded without a copy |
//! | `summary.rs` | the summary, read |
//! | `attached.rs` | files that are attached to it |
//! | `repair.rs` | a file without its end, completed |

mod append;
mod attached;
mod chunk;
mod contents;
mod damage;
mod lz4;
mod messages;
mod records;
mod repair;
mod store;
mod summary;
mod writer;

#[cfg(test)]
mod tests;

pub use contents::{ChannelInfo, Contents, Stretch};
pub use damage::Skipped;
pub use messages::{Message, Messages};
pub use records::{Head, Inside, RawRecord, Records};
pub use repair::{Scan, repair, scan};
pub use store::Store;
pub use summary::{Summary, chunk_indexes, footer, summary};
pub use writer::{Format, Writer};
