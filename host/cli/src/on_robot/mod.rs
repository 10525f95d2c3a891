//! The robot that wears the garment, for what shows it: the places of the taxels, the poses of the links, and
//! what presses where.
//!
//! | file | holds |
//! |---|---|
//! | `lines.rs` | places, poses and shapes as JSON |
//! | `wearer.rs` | the robot, its posture, and the garment on it |

mod lines;
mod wearer;

pub use lines::{BodyLine, BodyLink, FigureLine, FigureLink, PoseOfLink, PosesLine};
pub use wearer::Wearer;
