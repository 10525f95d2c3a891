//! What training has in common, whatever is learned.

pub mod confusion;
pub mod fingerprint;
pub mod folds;
pub mod linear;
