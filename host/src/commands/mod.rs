//! The commands: each is a module with its arguments and a function `run`.

pub mod bench;
pub mod board;
pub mod frames;
pub mod garment;
pub mod maps;
pub mod recordings;
pub mod shapes;
pub mod touches;
pub mod views;
