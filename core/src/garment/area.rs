//! Numbered panels; positions and rectangles on them.

use crate::format::Name;
use serde::{Deserialize, Serialize};

/// A numbered panel: its taxels are `base + row * columns + column`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Area {
    /// Name of the panel.
    pub name: Name,
    /// Link of the robot.
    pub link: Name,
    /// Index into [`Layout::regions`](super::Layout::regions).
    pub region: u8,
    /// Number of the first taxel.
    pub base: u16,
    /// Number of the first row, counting the rows of all panels.
    pub first_row: u16,
    /// Rows (y).
    pub rows: u16,
    /// Columns (x).
    pub columns: u16,
    /// Distance of taxel centres along x and y, micrometres; 0 if unknown.
    pub pitch_um: [u32; 2],
    /// Area of a taxel, see [`cell_mm2`].
    pub cell_mm2: u32,
    /// Taxels in 10 mm along the axis with the smaller pitch, Q8: 4 (655 mm) to 25,600 (0.1 mm).
    pub taxels_per_cm: u16,
}

impl Area {
    /// Converts a length in cm to taxels of this panel, both in the same fractions; below 2^17 of them.
    pub const fn taxels(&self, cm: u32) -> u32 {
        (cm * self.taxels_per_cm as u32) >> 8
    }

    /// Converts counts of a taxel of the reference garment, of 120 mm2, to those of a taxel of this panel at
    /// the same pressure, within 1 %. At most twice as many: on larger taxels a touch is mostly smaller than
    /// a taxel, and its force counts. The same counts if the pitch is unknown.
    #[inline(never)] // M0+: out of line
    pub(crate) fn counts_of(&self, usual: u32) -> u32 {
        if self.pitch_um[0] == 0 {
            return usual;
        }
        // Q7, without a division: 137 / 2^14 is 1 / 120, and exact at 120 and 240 mm2.
        let scale = (self.cell_mm2.min(240) * 137) >> 7;
        (usual * scale) >> 7
    }
}

/// Pitch of panels that give none: 10 mm, in micrometres.
pub const ASSUMED_PITCH_UM: u32 = 10_000;

/// Area of a taxel in mm2 on a panel of this pitch (0: unknown, 10 mm are assumed), rounded down, at least 1.
pub fn cell_mm2(pitch_um: [u32; 2]) -> u32 {
    let [x, y] = pitch_um.map(|um| if um == 0 { ASSUMED_PITCH_UM } else { um.min(655_399) } / 100);
    (x * y / 100).max(1)
}

/// Taxels per 10 mm, Q8, on a panel of this pitch (0: unknown, 10 mm are assumed), along the axis of the
/// smaller pitch. Rounded to the nearest: 4 at 655 mm to 25,600 at 0.1 mm.
pub fn taxels_per_cm(pitch_um: [u32; 2]) -> u16 {
    let um = pitch_um.map(|um| if um == 0 { ASSUMED_PITCH_UM } else { um.clamp(100, 655_399) });
    let least = um[0].min(um[1]);
    ((256 * ASSUMED_PITCH_UM + least / 2) / least) as u16
}

/// Position of a taxel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place {
    /// Index of the panel.
    pub panel: u8,
    /// Row (y).
    pub row: u16,
    /// Column (x).
    pub column: u16,
}

/// A rectangle of taxels of one panel, last row and column included. Aligned to words: these are copied
/// inline, where five half-words would take a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[repr(align(4))]
pub struct Rect {
    /// Index of the panel.
    pub panel: u8,
    /// First row.
    pub top: u16,
    /// Last row.
    pub bottom: u16,
    /// First column.
    pub left: u16,
    /// Last column.
    pub right: u16,
}

impl Rect {
    /// True if a taxel lies in the rectangle grown by `margin` on each side.
    pub const fn holds(&self, panel: u8, row: u16, column: u16, margin: u16) -> bool {
        self.panel == panel
            && row + margin >= self.top
            && row <= self.bottom + margin
            && column + margin >= self.left
            && column <= self.right + margin
    }

    /// True if the rectangle shares no taxel with another one, and is at most twice as high and as wide.
    pub const fn has_left(&self, other: &Rect) -> bool {
        let apart = self.panel != other.panel
            || self.top > other.bottom
            || other.top > self.bottom
            || self.left > other.right
            || other.left > self.right;
        apart
            && self.bottom - self.top <= 2 * (other.bottom - other.top) + 1
            && self.right - self.left <= 2 * (other.right - other.left) + 1
    }
}
