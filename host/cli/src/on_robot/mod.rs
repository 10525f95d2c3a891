//! The robot that carries the garment, for what shows it: the places of the taxels, the poses of the links, and
//! what presses where.
//!
//! | file | holds |
//! |---|---|
//! | `lines.rs` | places, poses and shapes as JSON |
//! | `shown.rs` | the robot, its posture, and the garment on it |

mod lines;
mod shown;

pub use lines::{BodyLine, BodyLink, FigureLine, FigureLink, PoseOfLink, PosesLine};
pub use shown::ShownRobot;
