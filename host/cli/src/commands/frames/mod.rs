//! Commands about recorded frames, without a board.

pub mod features;
pub mod process;
