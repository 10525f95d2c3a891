//! Messages of ROS 2, against the definitions that ROS reads.

mod definitions;
mod documents;
mod messages;
mod pressing;
mod robot;
