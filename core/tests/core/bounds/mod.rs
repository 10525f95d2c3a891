//! The largest errors that the documentation names (docs/evidence/bounds.md), against exact rationals and 60
//! digits, over exhaustive and random sweeps; and what functions do outside the interval that they are for.

mod axes;
mod condition;
mod exact;
mod images;
mod map;
mod nmi;
mod numbers;
mod quartic;
mod speed;
mod stability;
mod sums;
mod table;
