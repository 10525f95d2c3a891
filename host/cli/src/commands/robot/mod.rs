//! The commands of a board, of a robot's file: all its boards at once.

pub mod check;
mod controllers;
pub mod doctor;
pub mod live;
pub mod record;
mod requests;
#[cfg(feature = "ros2")]
pub mod ros2;
#[cfg(feature = "zenoh")]
pub mod serve;
mod shown;
mod tellers;
pub mod view;
mod viewed;
pub mod why;
