//! Pieces of a part that follow each other.

use super::part::Part;
use super::piece::Piece;
use crate::condition::row_of;
use crate::garment::{Area, Rect};

/// Pieces of a part that follow each other, from row to row.
pub(super) struct Strip<'a> {
    pub pieces: &'a [Piece],
    pub part: &'a Part,
    pub area: &'a Area,
    /// of all taxels
    pub values: &'a [u16],
}

impl Strip<'_> {
    /// Lets a rectangle of the panel hold them.
    pub fn widen(&self, rect: &mut Rect) {
        // The rows come one after the other.
        if let [first, ..] = self.pieces {
            rect.top = rect.top.min(first.row - self.area.first_row);
        }
        if let [.., last] = self.pieces {
            rect.bottom = last.row - self.area.first_row;
        }
        // Unrolled, a loop over them would begin with a division, which an M0+ does not have.
        let mut rest = self.pieces;
        while let [piece, after @ ..] = rest {
            rect.left = rect.left.min(piece.left);
            rect.right = rect.right.max(piece.right);
            rest = after;
        }
    }
}

/// The values from the first to the last taxel of a piece of a panel.
pub(super) fn values_of<'a>(piece: &Piece, area: &Area, values: &'a [u16]) -> &'a [u16] {
    let row = row_of(values, area, piece.row - area.first_row);
    row.get(piece.left.into()..=piece.right.into()).unwrap_or(&[])
}

/// Pieces that follow each other and were found as one part, as those of most parts are.
pub(super) fn strips(pieces: &[Piece]) -> impl Iterator<Item = &[Piece]> {
    let mut rest = pieces;
    // (`chunk_by` splits where it might panic.)
    core::iter::from_fn(move || {
        let part = rest.first()?.part;
        let length = rest.iter().position(|piece| piece.part != part).unwrap_or(rest.len());
        let (strip, after) = rest.split_at_checked(length)?;
        rest = after;
        Some(strip)
    })
}
