//! The parts and pieces of a frame: what the scan of its rows fills in, and the stages after it read.

use super::bits::WORD;
use super::run::Piece;
use super::strip::strips;
use super::union_find::{NONE, Part};
use crate::garment::{Area, Side};
use heapless::Vec;

/// The parts and pieces of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Labels<const RUNS: usize, const PARTS: usize> {
    /// In the order of rows, then words.
    pub pieces: Vec<Piece, RUNS>,
    /// In the order of their first taxels.
    pub parts: Vec<Part, PARTS>,
    /// Sides of panels that a piece touches, four bits for each panel.
    sides: u32,
    /// Number of pieces of this frame that did not fit, or whose parts did not.
    pub overflow: u16,
}

/// Returns the bit of a side among the four of its panel.
const fn bit(panel: u8, side: Side) -> u32 {
    1 << (panel as u32 % 8 * 4 + side as u32)
}

/// Position of the scan in a panel, and what it has found so far.
#[derive(Clone, Copy)]
pub(crate) struct Line {
    pub panel: u8,
    /// Row, counted over all panels.
    pub row: u16,
    /// Index of the first piece of the row above, or of this row if the row above has none.
    pub above: usize,
    /// Fast path of rows of one word: dilated mask and label of the row above, if it is all one part.
    pub reach: u32,
    pub part: u16,
    /// Taxels touched so far in the first and in the last words of the panel's rows.
    pub ends: [u32; 2],
}

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    pub const fn new() -> Self {
        const { assert!(PARTS < NONE as usize, "a part is numbered with 16 bits") };
        Labels { pieces: Vec::new(), parts: Vec::new(), sides: 0, overflow: 0 }
    }

    /// Empties all lists.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.parts.clear();
        self.sides = 0;
        self.overflow = 0;
    }

    /// Appends a piece to its part, or to a new part if that is [`NONE`]. Returns the part, and the piece if
    /// there is room.
    #[inline(always)]
    pub fn push(&mut self, mut piece: Piece, panel: u8) -> (u16, Option<&mut Piece>) {
        let mut fits = true;
        if piece.part == NONE {
            piece.part = self.parts.len() as u16;
            fits = self.parts.push(Part::new(piece.part, panel)).is_ok();
        }
        let part = piece.part;
        if !fits || self.pieces.push(piece).is_err() {
            self.overflow = self.overflow.saturating_add(1);
            return (part, None);
        }
        (part, self.pieces.last_mut())
    }

    /// Marks the sides of a panel that its pieces, those from `start` on, touch.
    pub(super) fn mark_sides(&mut self, start: usize, area: &Area, line: &Line) {
        let pieces = self.pieces.get(start..).unwrap_or(&[]);
        let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return };
        let [left, right] = line.ends;
        let mut mark = |touched: bool, side| {
            if touched {
                self.sides |= bit(line.panel, side);
            }
        };
        mark(first.row == area.first_row, Side::Top);
        mark(last.row - area.first_row + 1 >= area.rows, Side::Bottom);
        mark(left & 1 == 1, Side::Left);
        mark(right >> (area.columns.saturating_sub(1) % WORD) & 1 == 1, Side::Right);
    }

    /// True if a piece touches that side of a panel.
    pub const fn touches(&self, panel: u8, side: Side) -> bool {
        self.sides & bit(panel, side) != 0
    }

    /// Adds the sums of the pieces from `start` on to their parts.
    #[inline(never)] // M0+: out of line
    pub(super) fn weigh(&mut self, start: usize) {
        for pieces in strips(self.pieces.get(start..).unwrap_or(&[])) {
            let (mut mass, mut area, mut peak) = (0u32, 0u32, 0);
            for piece in pieces {
                mass = mass.wrapping_add(piece.sums.s0);
                area = area.wrapping_add(piece.area.into());
                if piece.peak > peak {
                    peak = piece.peak;
                }
            }
            let part = pieces.first().and_then(|piece| self.parts.get_mut(usize::from(piece.part)));
            if let Some(part) = part {
                part.add(mass, area.min(u16::MAX.into()) as u16, peak);
            }
        }
    }

    /// Makes the root the parent of each part, and gives it the sums of all.
    pub(super) fn flatten(&mut self) {
        for index in 0..self.parts.len() {
            let Some(part) = self.parts.get(index) else { return };
            let parent = usize::from(part.parent);
            if parent >= index {
                continue;
            }
            // Parts before this one have their root as parent already.
            let (mass, area, peak) = (part.mass, part.area, part.peak as u16);
            let Some(first) = self.parts.get(parent).map(|part| part.parent) else { return };
            if let Some(part) = self.parts.get_mut(index) {
                part.parent = first;
            }
            if let Some(part) = self.parts.get_mut(usize::from(first)) {
                part.add(mass, area, peak);
            }
        }
    }

    /// Renumbers contacts after component `lost` has become part of `whole`: those after it move up.
    pub fn renumber(&mut self, whole: u16, lost: u16) {
        for part in self.parts.iter_mut().filter(|part| part.contact != NONE) {
            let contact = if part.contact == lost { whole } else { part.contact };
            part.contact = contact - u16::from(contact > lost);
        }
    }

    /// Roots with their indices.
    pub fn whole_parts(&self) -> impl Iterator<Item = (u16, &Part)> {
        (0u16..).zip(&self.parts).filter(|(index, part)| part.parent == *index)
    }
}
