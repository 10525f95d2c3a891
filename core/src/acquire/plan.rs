//! The scan plan: what of the garment one frame reads, and how finely.

use serde::{Deserialize, Serialize};

/// Bits of a sample that are kept.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Depth {
    /// The upper 8 bits of the converter's 12 (the source's 256 grey levels); codes still span 0 ..= 4095.
    #[serde(rename = "8")]
    Eight,
    /// All 12 bits, transported exactly.
    #[default]
    #[serde(rename = "12")]
    Twelve,
}

impl Depth {
    /// The 12-bit code as kept.
    pub const fn keep(self, code: u16) -> u16 {
        match self {
            // The upper bits are repeated below, so that full scale stays full scale.
            Depth::Eight => (code & 0xff0) | (code >> 8 & 0xf),
            Depth::Twelve => code,
        }
    }
}

/// What one frame reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Panels to read, bit `i` for panel `i`.
    pub panels: u8,
    /// Blocks to read, bit `i` for block `i` of the garment.
    pub blocks: u64,
    /// Bits kept of each sample.
    pub depth: Depth,
}

impl Default for Plan {
    fn default() -> Plan {
        Plan { panels: u8::MAX, blocks: u64::MAX, depth: Depth::Twelve }
    }
}

impl Plan {
    /// Whether a block of a panel is to be read.
    pub const fn reads(&self, panel: u8, block: u8) -> bool {
        self.panels as u32 >> panel & 1 == 1 && self.blocks >> block & 1 == 1
    }
}
