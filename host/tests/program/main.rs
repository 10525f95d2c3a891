//! The program and its examples from outside.

mod builds;
mod cli;
mod commands;
#[path = "../library/drawn.rs"]
mod drawn;
#[cfg(feature = "foxglove")]
mod foxglove;
mod live;
mod maps;
mod own_garment;
mod reference;
mod schemas;
mod start;
mod status;
mod steps;
mod teach;
mod tools;
mod version;
mod view;
