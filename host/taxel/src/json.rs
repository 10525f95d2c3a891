//! JSON objects shared by all commands.
//!
//! Lengths are in taxels and, with `_mm`, in millimetres if the garment has a pitch; angles in radians, times
//! in seconds, pressure in counts. Floats are finite or `null`.

mod contact;
mod frames;
mod host_times;
pub mod lines;
mod meaning;
mod messages;
pub mod pins;
mod pressing;
mod printer;
#[cfg(feature = "schema")]
pub mod schema;

pub use contact::ContactLine;
pub use frames::{Replay, ReplayState};
pub use host_times::{HostTimed, HostTimes};
pub use meaning::MeaningOfTouch;
pub use messages::{line, message};
pub use pressing::{computed as computed_pressing, line as pressing, pose_error};
pub use printer::MessagePrinter;
