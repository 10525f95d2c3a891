//! The host side of taxel.

pub mod arrays;
pub mod cli;
pub mod fcm;
pub mod features;
pub mod scenes;
pub mod sim;
