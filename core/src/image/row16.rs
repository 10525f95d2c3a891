//! Rows of sixteen taxels, for which the hot loops are unrolled.

/// Taxels of such a row.
pub(crate) const ROW16: usize = 16;

/// A row of sixteen taxels.
pub(crate) type Row16 = [u16; ROW16];
