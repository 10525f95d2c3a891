//! The mind of a robot of several boards: what touches mean to the robot as a whole.
//!
//! | file | holds |
//! |---|---|
//! | `place.rs` | [`BodyPlace`]: where on the body a contact lies |
//! | `body_part.rs` | parts of the body that the map names |
//! | `felt.rs` | [`MindReader`]: what a board's events say of touches, in the board's thread |
//! | `speeds.rs` | [`LinkSpeeds`]: how fast the robot's own links move |
//! | `mover.rs` | [`Mover`]: whose motion has caused a touch |
//! | `probe.rs` | [`Probe`]: what a limb feels of what it moves into |
//! | `host_input.rs` | [`HostInputLine`]: what others know |
//! | `sensed_board.rs` | [`SensedTouch`]: what one board has said, and whose motion has caused it |
//! | `senses.rs` | [`Senses`]: the newest of all of these, each with its age |
//! | `robot_mind.rs` | [`RobotMind`]: the map of the robot over its senses |
//! | `recorded.rs` | [`RecordedMind`]: the mind of a robot whose boards are recorded |
//! | `line.rs` | what it means, as JSON and in words |
//! | `intent_ros2.rs` | the same as a message of ROS 2 |
//! | `reasons.rs` | why, down to the contacts |
//! | `virtual_robot.rs` | [`VirtualRobot`]: the boards of a robot and its mind, stepped by hand |
//!
//! The map is a file like those of boards ([`crate::fcm`]), and the stage that infers and announces is the
//! board's own; only its inputs are others ([`crate::fcm::robot_source`]). An input of which nothing is known
//! that is young enough has the default that the map states for it.

mod body_part;
mod felt;
mod host_input;
mod intent_ros2;
mod line;
mod mover;
mod place;
mod probe;
mod reasons;
mod recorded;
mod robot_mind;
mod sensed_board;
mod senses;
mod speeds;
mod virtual_robot;

pub use felt::{BoardPlacement, BoardSense, FeltContact, MindReader};
#[cfg(feature = "schema")]
pub use host_input::host_input_schema;
pub use host_input::{HOST_INPUT, HOST_INPUT_SCHEMA, HostInputLine, HostInputMessage};
pub use intent_ros2::robot_intent_message;
#[cfg(feature = "schema")]
pub use line::robot_intent_schema;
pub use line::{ROBOT_INTENT, ROBOT_INTENT_SCHEMA, RobotMeaningLine, RobotTouchLine};
pub use mover::{Approach, BasePlace, Mover, SurfaceSpot};
pub use place::BodyPlace;
pub use probe::{Probe, ProbeCourse};
pub use reasons::{ReasonInput, RobotReasons};
pub use recorded::RecordedMind;
pub use robot_mind::{RobotMeaning, RobotMind};
pub use sensed_board::SensedTouch;
pub use senses::{SenseCause, SensedValue, Senses};
pub use speeds::{LinkSpeeds, LinksAt};
pub use virtual_robot::VirtualRobot;
