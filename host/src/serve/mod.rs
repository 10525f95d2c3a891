//! What stands before both servers of this program, the page's and Foxglove's, so that none of their guests
//! shuts others out.
//!
//! | file | holds |
//! |---|---|
//! | `door.rs` | who is let in: so many at a time, the newest before the one that has been served longest |
//! | `http.rs` | the head of a request, from which site it comes, and short answers |
//! | `hurry.rs` | a writer for guests that read slowly: up to a point |
//! | `mute.rs` | a stream for who only reads |

mod door;
pub mod http;
mod hurry;
mod mute;

pub use door::{Guest, open};
pub use hurry::Hurry;
pub use mute::Mute;
