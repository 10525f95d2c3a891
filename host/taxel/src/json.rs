//! JSON objects shared by all commands.
//!
//! A key says its unit (`_mm`, `_m`, `_n`, `_rad`, `_us`, `_ms`); without one, lengths are in taxels and pressure in
//! counts. A quantity has the same key, unit and value wherever it is told: here, in Python, in tables, and in the
//! messages of `taxel_msgs`, whose standard parts are in ROS's units. Forces in newtons say what they rest on
//! (`force_basis`). Floats are finite or `null`.

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
pub(crate) use pressing::pose_error;
pub use pressing::{computed as computed_pressing, line as pressing};
pub use printer::MessagePrinter;
