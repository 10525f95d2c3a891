//! An image on its way to the pages.

use serde::Serialize;
use std::sync::Arc;

/// The text of a message.
pub fn text(line: &impl Serialize) -> Arc<str> {
    // Numbers, texts and keys that are texts: this cannot fail.
    serde_json::to_string(line).unwrap_or_default().into()
}

/// An image and its contacts.
#[derive(Debug, Clone)]
pub struct Shot {
    /// Line as printed by `taxel live --json`.
    pub line: Arc<str>,
    /// Pressure by taxel, counts.
    pub image: Arc<[u16]>,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Sum of all contacts, counts.
    pub total: u32,
}
