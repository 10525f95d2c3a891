//! Reads the records of a file that may be damaged by a kill, a power cut, or a failing disk.
//!
//! Records are read one after the other. Where none is readable, the next readable one is searched for: at
//! the offsets listed in the file's summary, else byte by byte. The bytes between are damage.
//!
//! | file | holds |
//! |---|---|
//! | `piece.rs` | one record, and whether it is read to its last byte |
//! | `opened.rs` | a chunk with a valid checksum, and its contents |
//! | `marks.rs` | places of records listed by the file's end |
//! | `likely.rs` | whether a record begins at an offset |
//! | `walk.rs` | the records, one after the other |

mod likely;
mod marks;
mod opened;
mod piece;
mod walk;

pub use piece::{Kind, Opened, Piece};
pub use walk::{Unreadable, Walk, WalkStep};
