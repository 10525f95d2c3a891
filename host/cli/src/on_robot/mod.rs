//! The robot that wears the garment, for what shows it: the places of the taxels, the poses of the links, and
//! what presses where.
//!
//! | file | holds |
//! |---|---|
//! | `lines.rs` | places and poses as JSON |
//! | `wearer.rs` | the robot, its posture, and the garment on it |

mod lines;
mod wearer;

pub use lines::{BodyLine, BodyLink, PoseOfLink, PosesLine};
pub use wearer::Wearer;
