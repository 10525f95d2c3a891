//! Messages of ROS 2: their layout on the wire, shared by recordings ([`record`](crate::record)) and by the
//! node `taxel ros2`.
//!
//! | file | holds |
//! |---|---|
//! | `cdr.rs` | the encoding |
//! | `names.rs` | names as parts of topics |
//! | `messages.rs` | what a board reports, as standard messages |
//! | `own.rs` | what a board reports, as messages of the package `taxel_msgs` |
//! | `pressing.rs` | what presses on the robot, by link |
//! | `motion.rs` | what a robot is commanded |
//! | `parameters.rs` | names of the node's parameters |
//! | `topics.rs` | topics and services of the node, with their types and qualities of service |
//! | `schemas.rs` | definitions of the standard messages |

mod cdr;
pub mod messages;
pub mod motion;
mod names;
pub mod own;
pub mod parameters;
pub mod pressing;
pub mod schemas;
pub mod topics;

pub use cdr::Cdr;
pub use names::topic_part;
