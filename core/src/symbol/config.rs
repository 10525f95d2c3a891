//! Settings of the stage: the limits between words.

use serde::{Deserialize, Serialize};

/// Limits between the words; each list is ascending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SymbolConfig {
    /// Total pressure in counts from which a touch is light, firm, hard; below the first it is faint.
    pub strength: [u32; 3],
    /// Area in cm2 from which a touch is a patch, a wide one; below the first it is a point.
    pub extent: [u16; 2],
    /// Duration in ms from which a touch is short, long; below the first it is brief.
    pub span_ms: [u32; 2],
}

impl Default for SymbolConfig {
    /// At 1000 counts per newton: light from 1 N, firm from 5 N, hard from 20 N.
    fn default() -> Self {
        SymbolConfig { strength: [1_000, 5_000, 20_000], extent: [9, 40], span_ms: [150, 800] }
    }
}
