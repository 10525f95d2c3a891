//! The 3x3 filters.
//!
//! [`kinds`] names them and applies one: [`conservative`] (by [`clamp`] and [`clamp_row16`]; its persistent
//! form stores [`points`]), [`median`] and [`square`]. [`row`] walks a row run by run.

pub(crate) mod clamp;
pub(crate) mod clamp_row16;
pub(crate) mod conservative;
pub(crate) mod kinds;
pub(crate) mod median;
#[cfg(target_pointer_width = "64")]
pub(crate) mod median_simd;
pub(crate) mod points;
pub(crate) mod row;
pub(crate) mod square;
