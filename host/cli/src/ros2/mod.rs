//! ROS 2 nodes, without a ROS: publish a board's stream over DDS, and take joint states and concepts.
//!
//! Topics, types and qualities of service are in [`taxel::ros2::topics`], the layout of the messages in
//! [`taxel::ros2`]. The node is part of the program, not of the library: whoever writes a program around
//! `taxel` has a client of ROS already, and the library stays free of DDS.
//!
//! | file | holds |
//! |---|---|
//! | `names.rs` | names of topics in the node's namespace |
//! | `raw.rs` | messages as they go over the wire |
//! | `node.rs` | the node, its publishers and subscriptions |
//! | `inbox.rs` | what has come for it, a few at a time |
//! | `parameters.rs` | its parameters |
//! | `panels.rs` | images, points and forces of the panels, thinned |
//! | `links.rs` | what presses on the robot's links |
//! | `posture.rs` | joint states on their way to the board |
//! | `concepts.rs` | concepts on their way to the board |
//! | `services.rs` | services, and the board's answers to them |
//! | `show.rs` | [`RosShow`]: hands the stream to all of them |
//! | `host_input.rs` | what others send a robot of several boards, on its way to its mind |
//! | `motion.rs` | [`MotionNode`]: the node of a robot that is moved by touch |
//! | `robot.rs` | [`RobotNode`]: the node of a robot of several boards |

mod concepts;
mod host_input;
mod inbox;
mod links;
mod motion;
mod names;
mod node;
mod panels;
mod parameters;
mod posture;
mod raw;
mod robot;
mod services;
mod show;

pub use motion::MotionNode;
pub use names::RosPlace;
pub use node::{DOMAINS, RosNode};
pub use parameters::RosParameters;
pub use robot::RobotNode;
pub use show::RosShow;
