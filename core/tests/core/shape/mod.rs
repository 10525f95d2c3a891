//! Shapes: what is recognised, from codes to class.

mod built_in;
mod drawn;
mod rig;
