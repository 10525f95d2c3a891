//! Recordings through the pipeline, and what is learned from them. `cargo xtask test --recorded` runs these;
//! they read the folders that TAXEL_DATA lists.

mod data;
#[path = "../../../core/tests/core/dense.rs"]
mod dense;
mod features;
mod frames;
#[path = "../program/reference.rs"]
mod reference;
#[path = "../library/shape_of.rs"]
mod shape_of;
mod shapes;
#[path = "../program/start.rs"]
mod start;
mod touches;
