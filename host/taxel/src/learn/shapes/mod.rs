//! Objects taught by touch: more examples for a base of shapes, in the integers of the board.

pub mod cluster;
pub mod confidence;
pub mod extend;
pub mod prune;
