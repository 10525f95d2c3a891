//! Recordings through the pipeline, and models trained on them. `cargo xtask test --recorded` runs these
//! tests on the folders listed by TAXEL_DATA.

mod arrays;
mod data;
#[path = "../../../../core/tests/core/dense.rs"]
mod dense;
mod features;
mod frames;
#[path = "../program/reference.rs"]
mod reference;
#[path = "../../../../core/tests/core/shape/rig.rs"]
mod shape_of;
mod shapes;
#[path = "../program/start.rs"]
mod start;
mod touches;
