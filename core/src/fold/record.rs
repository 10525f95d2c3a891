//! A fold's entry in the table, and a taxel's entry at a knot.

use bytemuck::{Pod, Zeroable};

/// Number of a joint that stands for none.
pub const NO_JOINT: u8 = u8::MAX;

/// Number that fills the list of a fold's taxels up to a multiple of four.
pub const NO_TAXEL: u16 = u16::MAX;

/// A fold, as it lies in flash: 20 bytes, little-endian. Of a fold of one joint the second element of each
/// pair is [`NO_JOINT`], 1 knot, and otherwise 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct FoldRecord {
    /// Numbers of its joints in the table.
    pub joints: [u8; 2],
    /// Number of knots of each joint. A taxel has a cell for each pair of knots, those of the second joint
    /// one after the other.
    pub knots: [u8; 2],
    /// Angle of the first knot, hundredths of a degree.
    pub first: [i16; 2],
    /// Angle between knots, hundredths of a degree.
    pub step: [u16; 2],
    /// Turn by which a joint goes back before its sleeve follows: half the width of the play, hundredths of
    /// a degree.
    pub play: [u16; 2],
    /// Number of taxels.
    pub taxels: u16,
    /// 0.
    pub zero: u16,
}

/// Pressure on a taxel at a knot, in units of the table.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct FoldCell {
    /// Expected pressure.
    pub mean: u8,
    /// Most by which it differs from the day's own mean.
    pub spread: u8,
    /// Most by which a day's mean differs from `mean`.
    pub days: u8,
}

impl FoldRecord {
    /// Cells of each taxel.
    pub const fn cells(&self) -> usize {
        self.knots[0] as usize * self.knots[1] as usize
    }

    /// Number of words that hold a byte of each taxel, four to a word.
    pub const fn quads(&self) -> usize {
        (self.taxels as usize).div_ceil(4)
    }

    /// Condition that the entry breaks, if any: for a table of `joints` joints.
    pub(super) fn fault(&self, joints: u8) -> Option<&'static str> {
        let [first, second] = self.joints;
        if first >= joints || second != NO_JOINT && (second >= joints || second == first) {
            return Some("must name one or two joints of the table");
        }
        let is_single = second == NO_JOINT;
        if is_single && (self.knots[1], self.first[1], self.step[1], self.play[1]) != (1, 0, 0, 0) {
            return Some("must leave out what belongs to a second joint");
        }
        let steps = if is_single { &self.step[..1] } else { &self.step[..] };
        if self.knots.contains(&0) || steps.contains(&0) || self.zero != 0 {
            return Some("must have knots, and angles between them");
        }
        if self.play.iter().any(|play| *play > 9000) {
            return Some("must have a play of at most 90 degrees");
        }
        None
    }
}
