//! Strips: consecutive pieces of one part.

use super::run::Piece;
use super::union_find::Part;
use crate::garment::{Area, Rect};
use crate::image::slices::row_of;

/// Consecutive pieces of one part, from row to row.
pub(crate) struct Strip<'a> {
    pub pieces: &'a [Piece],
    pub part: &'a Part,
    pub area: &'a Area,
    /// Values of all taxels.
    pub values: &'a [u16],
}

impl Strip<'_> {
    /// Widens a rectangle of the panel so that it holds the pieces.
    pub fn widen(&self, rect: &mut Rect) {
        // The rows are in ascending order.
        if let [first, ..] = self.pieces {
            rect.top = rect.top.min(first.row - self.area.first_row);
        }
        if let [.., last] = self.pieces {
            rect.bottom = last.row - self.area.first_row;
        }
        // A `for` loop would be unrolled and begin with a division, which an M0+ does not have.
        let mut rest = self.pieces;
        while let [piece, after @ ..] = rest {
            rect.left = rect.left.min(piece.left);
            rect.right = rect.right.max(piece.right);
            rest = after;
        }
    }
}

/// Returns the values from the first to the last column of a piece.
pub(crate) fn values_of<'a>(piece: &Piece, area: &Area, values: &'a [u16]) -> &'a [u16] {
    let row = row_of(values, area, piece.row - area.first_row);
    row.get(piece.left.into()..=piece.right.into()).unwrap_or(&[])
}

/// Splits pieces into strips of equal label.
pub(crate) fn strips(pieces: &[Piece]) -> impl Iterator<Item = &[Piece]> {
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
