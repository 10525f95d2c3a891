//! Postures at the times of frames: joints are read at other times than a board scans.
//!
//! | file | holds |
//! |---|---|
//! | `motion.rs` | what bounds the errors |
//! | `track.rs` | the readings of one joint, between them and after them |
//! | `history.rs` | those of all joints: the posture at a time |

mod history;
mod motion;
mod track;

pub use history::{Estimate, Gap, JointHistory};
pub use motion::Motion;
