//! Boards: one file each with its pin assignment. No other part of the firmware names a pin.

mod feather;
mod parts;

pub use feather::take;
pub use parts::BoardParts;
