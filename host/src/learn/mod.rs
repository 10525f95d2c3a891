//! Parts shared by all training.

pub mod confusion;
pub mod fingerprint;
pub mod folds;
pub mod linear;
