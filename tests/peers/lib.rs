//! The core beside other libraries: the panels that all see, and what each does with them.

pub mod chains;
pub mod ours;
pub mod scenes;
