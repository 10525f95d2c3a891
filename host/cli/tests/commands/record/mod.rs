//! `taxel record`, replays, `export` and `report` through the library: nothing that a board sends is lost or
//! changed.

mod belonging;
mod calibrated;
mod exports;
mod one_value;
mod replayed;
mod report;
mod rotate;
mod scenes;
pub mod stage;
mod wire;
