//! Training of what a board recognises: shapes, touches over time, folds of the garment; and the parts that
//! these share.

pub mod confusion;
pub mod doubts;
pub mod fingerprint;
pub mod folds;
pub mod linear;
pub mod shapes;
pub mod stratified;
pub mod touches;
