//! Queries of a frame's pieces by position.

use super::bits::WORD;
use super::labels::Labels;
use super::run::{Piece, key};
use super::union_find::NONE;
use crate::garment::Area;

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Root of the part of a piece.
    pub fn part_of(&self, piece: &Piece) -> Option<u16> {
        Some(self.parts.get(usize::from(piece.part))?.parent)
    }

    /// Pieces of the rows `first ..= last`, counted over all panels, with their indices.
    pub fn in_rows(&self, first: u16, last: u16) -> impl Iterator<Item = (usize, &Piece)> {
        let from = self.pieces.partition_point(|piece| piece.row < first);
        let pieces = (from..).zip(self.pieces.get(from..).unwrap_or(&[]));
        pieces.take_while(move |(_, piece)| piece.row <= last)
    }

    /// Returns the taxels of piece `number` that have all four neighbours touched, in its panel `area`.
    pub fn enclosed(&self, number: usize, piece: &Piece, area: &Area) -> u32 {
        let (Piece { taxels, row, .. }, column) = (*piece, piece.column());
        let last = area.first_row.saturating_add(area.rows).saturating_sub(1);
        if row <= area.first_row || row >= last {
            return 0;
        }
        let above = self.all_before(number, key(row - 1, column));
        let below = self.all_after(number, key(row + 1, column));
        let mut left = taxels << 1;
        if column > 0 {
            left |= self.all_before(number, key(row, column - 1)) >> (WORD - 1);
        }
        let mut right = taxels >> 1;
        if taxels >> (WORD - 1) != 0 && column < u16::MAX - WORD {
            right |= self.all_after(number, key(row, column + WORD)) << (WORD - 1);
        }
        taxels & above & below & left & right
    }

    /// Returns all touched taxels of a word that comes before piece `number`.
    #[inline(never)] // M0+: out of line
    fn all_before(&self, number: usize, word: u32) -> u32 {
        let pieces = self.pieces.get(..number).unwrap_or(&[]);
        let last = pieces.iter().rev().find(|piece| piece.key() <= word);
        last.filter(|piece| piece.key() == word).map_or(0, |piece| piece.all)
    }

    /// Returns all touched taxels of a word that comes after piece `number`.
    #[inline(never)] // M0+: out of line
    fn all_after(&self, number: usize, word: u32) -> u32 {
        let pieces = self.pieces.get(number + 1..).unwrap_or(&[]);
        let first = pieces.iter().find(|piece| piece.key() >= word);
        first.filter(|piece| piece.key() == word).map_or(0, |piece| piece.all)
    }

    /// Contact of a taxel; valid once contacts are numbered.
    pub fn contact_at(&self, area: &Area, row: u16, column: u16) -> Option<u16> {
        let word = key(area.first_row.saturating_add(row), column);
        let first = self.pieces.partition_point(|piece| piece.key() < word);
        let mut pieces = self.pieces.get(first..)?.iter().take_while(|piece| piece.key() == word);
        self.contact_of(pieces.find(|piece| piece.holds(column))?)
    }

    /// Contact of a piece; valid once contacts are numbered.
    pub fn contact_of(&self, piece: &Piece) -> Option<u16> {
        let part = self.parts.get(usize::from(piece.part))?;
        (part.contact != NONE).then_some(part.contact)
    }
}
