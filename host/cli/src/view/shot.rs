//! An image on its way to the pages.

use std::sync::Arc;

/// An image and its contacts.
#[derive(Debug, Clone)]
pub struct Shot {
    /// Its line as printed by `taxel live --json`.
    pub line: Arc<str>,
    /// Pressure by taxel, counts.
    pub image: Arc<[u16]>,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Sum of all contacts, counts.
    pub total: u32,
}
