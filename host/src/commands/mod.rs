//! The commands: each is a module with its arguments and a function `run`.

pub mod views;
