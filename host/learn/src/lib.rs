//! Training and judging of the models that taxel ships, on recorded data sets.
//!
//! `cargo learn` runs it from a clone of the repository. A model that it writes is what a board runs: in integers,
//! of the size that fits, and every figure that it reports is that of these integers.
//!
//! | module | trains and judges |
//! |---|---|
//! | [`shapes`] | bases of objects, from images of single touches |
//! | [`meaning`] | the cognitive map of a touch, on scripts of touches by several hands |
//! | [`touches`] | models of gestures and intention, from frames of touches over time |
#![forbid(unsafe_code)]

pub mod commands;
pub mod linear;
pub mod meaning;
pub mod shapes;
pub mod stratified;
pub mod touches;
