//! Recordings through the pipeline. `cargo xtask test --recorded` runs these
//! tests on the folders listed by TAXEL_DATA.

mod arrays;
mod data;
#[path = "../../../../core/tests/core/dense.rs"]
mod dense;
mod docs;
mod features;
mod frames;
#[path = "../../../taxel/tests/library/reference.rs"]
mod reference;
#[path = "../../../../core/tests/core/shape/rig.rs"]
mod shape_of;
mod shapes;
