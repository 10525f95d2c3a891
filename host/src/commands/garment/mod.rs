//! Commands about a garment: its files, and from raw codes its wiring, forces and settling time.

pub mod calibrate;
pub mod config;
pub mod scenes;
pub mod settle;
pub mod setup;
