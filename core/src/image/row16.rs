//! Rows of sixteen taxels, for which the hot loops are unrolled.

/// Taxels of such a row.
pub(crate) const SIXTEEN: usize = 16;

/// A row of sixteen taxels.
pub(crate) type Sixteen = [u16; SIXTEEN];
