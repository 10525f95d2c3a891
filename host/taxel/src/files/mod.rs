//! Files that users name: outputs, recorded frames, garments, scripts of touches, calibrations.

pub mod arrays;
pub mod calibrate;
pub mod garments;
pub mod output;
pub mod rows;
pub mod schemas;
pub mod scripts;
