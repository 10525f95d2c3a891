//! Positions of taxels.

/// Position of a taxel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Spot {
    pub panel: u8,
    pub row: u16,
    pub column: u16,
}

impl Spot {
    /// True if another taxel of the panel is at most `reach` rows and columns away.
    pub fn is_near(self, other: Spot, reach: u16) -> bool {
        self.panel == other.panel
            && self.row.abs_diff(other.row) <= reach
            && self.column.abs_diff(other.column) <= reach
    }
}
