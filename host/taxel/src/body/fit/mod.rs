//! Fit of a garment: the place of each panel on its link, found by touches whose place on the robot is known.
//!
//! Along its surface a panel has three ways to be elsewhere than its body file says: to the right, down, and
//! turned. Touches come from marks on the robot, one after the other, or from the robot's own hand, whose
//! place kinematics gives. A few may be wrong: the placing is the one on which most agree.
//!
//! | file | holds |
//! |---|---|
//! | `touch.rs` | touches whose place is known, and files of them |
//! | `marks.rs` | places to be touched |
//! | `gather.rs` | touches in a board's lists of contacts |
//! | `registered.rs` | turn and shift between points of a plane |
//! | `found.rs` | how each panel sits |
//! | `written.rs` | the body file that says so |

mod found;
mod gather;
mod marks;
mod registered;
mod touch;
mod written;

pub use found::{BodyFit, FittedTouch, PatchFit};
pub use gather::{FeltTouch, TouchGatherer};
pub use marks::{Mark, marks, picked};
pub use touch::{KnownTouch, known_touches};

pub(super) use found::fit;
pub(super) use written::written;
