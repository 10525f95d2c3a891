//! Tables that come in pieces: what they hold, and the one being received.

use crate::capacity;
use crate::fold::{CELLS, FOLDED, FOLDS, fold_table_bytes};
use crate::surface::table_bytes;
#[cfg(any(feature = "surface", feature = "folds"))]
use crate::wire::TABLE_PIECE;
use heapless::Vec;

/// What a table in flash holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableKind {
    /// Where the taxels lie, see [`Table`](crate::surface::Table).
    Surface,
    /// What the garment's folds press, see [`FoldTable`](crate::fold::FoldTable).
    Folds,
}

impl TableKind {
    /// The kinds that this build has a use for.
    pub const USED: &[TableKind] = match (cfg!(feature = "surface"), cfg!(feature = "folds")) {
        (true, true) => &[TableKind::Surface, TableKind::Folds],
        (true, false) => &[TableKind::Surface],
        (false, true) => &[TableKind::Folds],
        (false, false) => &[],
    };

    /// Length of the longest table: that of a garment of [`capacity::TAXELS`] taxels.
    pub const fn bytes(self) -> usize {
        match self {
            TableKind::Surface => table_bytes(capacity::TAXELS),
            TableKind::Folds => fold_table_bytes(FOLDS, FOLDED, CELLS),
        }
    }
}

/// True if this build has a use for any table.
pub(super) const TABLES: bool = !TableKind::USED.is_empty();

/// A piece of a table, to be stored.
#[derive(Debug, Clone, Copy)]
pub struct PieceToStore<'a> {
    /// What the table holds.
    pub kind: TableKind,
    /// Length of the whole table.
    pub length: u32,
    /// Position of the piece in it, a multiple of 256.
    pub offset: u32,
    /// The piece: 256 bytes, or what is left.
    pub bytes: &'a [u8],
    /// Number of times that the flash may be written soon after this; a reset grants no more.
    pub saves: u8,
}

/// The table being received.
#[derive(Debug, Clone, Copy)]
pub(super) struct Upload {
    pub kind: TableKind,
    pub length: u32,
    pub stored: u32,
    /// The table, once all of it is stored.
    pub whole: Option<&'static [u8]>,
}

/// The next table.
pub(super) struct Uploads {
    /// The table being received; a build without tables has no room for one.
    upload: [Option<Upload>; TABLES as usize],
    #[cfg(any(feature = "surface", feature = "folds"))]
    pub piece: Vec<u8, TABLE_PIECE>,
    #[cfg(not(any(feature = "surface", feature = "folds")))]
    pub piece: Vec<u8, 0>,
}

impl Uploads {
    pub const fn new() -> Uploads {
        Uploads { upload: [None; TABLES as usize], piece: Vec::new() }
    }

    /// What the table being received, or received last, holds.
    pub fn kind(&self) -> TableKind {
        self.upload().map_or(TableKind::Surface, |upload| upload.kind)
    }

    /// The table being received.
    pub fn upload(&self) -> Option<Upload> {
        self.upload.first().copied().flatten()
    }

    /// Sets the table being received.
    pub fn set(&mut self, upload: Option<Upload>) {
        self.upload.fill(upload);
    }
}
