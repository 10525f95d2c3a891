//! Sets of reports.

/// Set of reports, a bit for each number: the lowest is the most urgent.
pub(crate) type Reports = u32;

/// The set of one report.
pub(crate) const fn only(number: u32) -> Reports {
    1 << number
}
