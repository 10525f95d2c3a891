//! The mind of a robot of several boards.

mod dropped;
mod families;
mod files;
mod reasons;
mod spread;
mod worn;
