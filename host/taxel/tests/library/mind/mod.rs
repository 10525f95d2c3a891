//! The mind of a robot of several boards.

mod dropped;
mod families;
mod files;
mod mover;
mod probed;
mod probes;
mod reasons;
mod schemas;
mod spread;
mod touched;
