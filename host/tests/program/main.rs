//! The program and its examples from outside.

mod cli;
mod commands;
#[path = "../library/drawn.rs"]
mod drawn;
#[cfg(feature = "foxglove")]
mod foxglove;
mod live;
mod reference;
mod schemas;
mod start;
mod teach;
mod tools;
mod version;
mod view;
