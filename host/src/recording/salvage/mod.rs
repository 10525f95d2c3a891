//! The records of a file that may be damaged: after a kill, a power cut, or on a disk that loses bits.
//!
//! The records are read one after the other. Where none can be read, the next one that can is searched for:
//! at the places that the file's summary names, else byte by byte. What lies between is damage.
//!
//! | file | holds |
//! |---|---|
//! | `piece.rs` | one record, and whether it is read to its last byte |
//! | `opened.rs` | a chunk whose checksum fits, and what is in it |
//! | `marks.rs` | where the file's end says that its records lie |
//! | `likely.rs` | whether a record begins at a place |
//! | `walk.rs` | the records, one after the other |

mod likely;
mod marks;
mod opened;
mod piece;
mod walk;

pub use opened::Opened;
pub use piece::{Kind, Piece, fields};
pub use walk::{Damage, Step, Walk};
