//! The commands of a board, of a robot's file: all its boards at once.

pub mod check;
mod controllers;
pub mod doctor;
mod lines;
pub mod live;
pub mod record;
mod requests;
#[cfg(feature = "ros2")]
pub mod ros2;
#[cfg(feature = "zenoh")]
pub mod serve;
pub mod view;
pub mod why;
