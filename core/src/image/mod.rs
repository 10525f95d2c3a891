//! The conditioned image, and where it may be non-zero.
//!
//! [`images`] holds a frame before and after the filter, [`view`] is what later stages read. [`rows`] marks
//! the columns of each row that may be non-zero, [`row_set`] the rows; [`slices`] finds panels and rows in
//! lists by taxel number, and [`row16`] is the row of sixteen.

pub(crate) mod images;
pub(crate) mod row16;
pub(crate) mod row_set;
pub(crate) mod rows;
pub(crate) mod slices;
pub(crate) mod view;
