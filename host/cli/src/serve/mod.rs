//! Shared by both servers of this program, the page's and Foxglove's, so that no client shuts others out.
//!
//! | file | holds |
//! |---|---|
//! | `door.rs` | admission: a limited number at a time; the newest displaces the one served longest |
//! | `http.rs` | the head of a request, its site of origin, and short responses |
//! | `hurry.rs` | a writer that waits for slow clients up to a limit |
//! | `mute.rs` | a read-only stream |

mod door;
pub mod http;
mod hurry;
mod mute;

pub use door::{Guest, open};
pub use hurry::Hurry;
pub use mute::Mute;
