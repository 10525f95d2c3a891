//! The host side of taxel.

pub mod fcm;
pub mod sim;
