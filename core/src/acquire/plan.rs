//! The scan plan: panels and blocks that one frame reads, and their resolution.

use serde::{Deserialize, Serialize};

/// Resolution and order of a scan: bits kept, or number of scans averaged, which divides the frame rate by as
/// much.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Depth {
    /// The upper 8 bits of the converter's 12 (the source's 256 grey levels); codes still span 0 ..= 4095.
    #[serde(rename = "8")]
    Eight,
    /// All 12 bits, transported exactly.
    #[default]
    #[serde(rename = "12")]
    Twelve,
    /// The mean of two scans of 12 bits, rounded to a whole code; so are those of four and eight.
    #[serde(rename = "mean of 2")]
    MeanOf2,
    /// The mean of four scans.
    #[serde(rename = "mean of 4")]
    MeanOf4,
    /// The mean of eight scans.
    #[serde(rename = "mean of 8")]
    MeanOf8,
    /// All 12 bits, in the order of [`Fields`](super::Fields): every part of the garment is sampled in each
    /// sub-field of a frame, which a reflex within a frame needs.
    #[serde(rename = "12 interlaced")]
    Interlaced,
}

impl Depth {
    /// Distance between adjacent codes.
    pub const fn step(self) -> u16 {
        match self {
            Depth::Eight => 16,
            Depth::Twelve | Depth::MeanOf2 | Depth::MeanOf4 | Depth::MeanOf8 | Depth::Interlaced => 1,
        }
    }

    /// Reduces a 12-bit code to the bits kept.
    pub const fn keep(self, code: u16) -> u16 {
        match self {
            // The upper bits are repeated below: full scale stays full scale.
            Depth::Eight => (code & 0xff0) | (code >> 8 & 0xf),
            Depth::Twelve | Depth::MeanOf2 | Depth::MeanOf4 | Depth::MeanOf8 | Depth::Interlaced => code,
        }
    }

    /// log2 of the number of scans of a frame.
    const fn doublings(self) -> u32 {
        match self {
            Depth::Eight | Depth::Twelve | Depth::Interlaced => 0,
            Depth::MeanOf2 => 1,
            Depth::MeanOf4 => 2,
            Depth::MeanOf8 => 3,
        }
    }

    /// Scans per frame.
    pub const fn scans(self) -> u16 {
        1 << self.doublings()
    }

    /// Mean of [`Depth::scans`] 12-bit codes with this sum; halves are rounded up.
    pub const fn mean(self, sum: u16) -> u16 {
        self.keep((sum + self.scans() / 2) >> self.doublings())
    }
}

/// Panels and blocks that one frame reads, and the resolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Panels to read, bit `i` for panel `i`.
    pub panels: u8,
    /// Blocks to read, bit `i` for block `i` of the garment.
    pub blocks: u64,
    /// Resolution and order.
    pub depth: Depth,
}

impl Default for Plan {
    fn default() -> Plan {
        Plan { panels: u8::MAX, blocks: u64::MAX, depth: Depth::Twelve }
    }
}

impl Plan {
    /// True if the plan reads a block of a panel.
    pub const fn reads(&self, panel: u8, block: u8) -> bool {
        self.reads_panel(panel) && self.blocks >> block & 1 == 1
    }

    /// True if the plan may read blocks of a panel.
    pub const fn reads_panel(&self, panel: u8) -> bool {
        self.panels as u32 >> panel & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_is_rounded_once() {
        for (depth, scans) in
            [(Depth::Twelve, 1), (Depth::MeanOf2, 2), (Depth::MeanOf4, 4), (Depth::MeanOf8, 8)]
        {
            assert_eq!((depth.scans(), depth.mean(4095 * scans)), (scans, 4095));
            for sum in 0..=4095 * scans {
                let exact = f64::from(sum) / f64::from(scans);
                assert_eq!(f64::from(depth.mean(sum)), (exact + 0.5).floor());
            }
        }
    }
}
