//! Messages of ROS 2: their layout on the wire, shared by recordings ([`record`](crate::record)) and by the
//! node `taxel ros2`.
//!
//! | file | holds |
//! |---|---|
//! | `cdr.rs` | the encoding |
//! | `names.rs` | names as parts of topics |
//! | `messages.rs` | what a board reports, as standard messages |
//! | `schemas.rs` | definitions of the standard messages |

mod cdr;
pub mod messages;
mod names;
pub mod schemas;

pub use cdr::Cdr;
pub use names::topic_part;
