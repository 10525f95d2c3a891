//! Files that users name: outputs, recorded frames, garments, tables of folds, bases of shapes, scripts of touches, calibrations.

#[cfg(not(target_family = "wasm"))]
pub mod arrays;
pub mod bases;
pub mod calibrate;
pub mod folds;
pub mod garments;
pub mod input;
pub mod output;
pub mod rows;
pub mod schemas;
pub mod scripts;
