//! Tables that lie in flash: a table comes in pieces, and is stored beside the one of its kind in force.

use super::reading;
use super::refusal::Refusal;
use crate::capacity;
use crate::fold::{CELLS, FOLDED, FOLDS, FoldTable, fold_table_bytes};
use crate::format::Invalid;
use crate::garment::Layout;
use crate::surface::{Table, table_bytes};
use crate::wire::{TABLE_PIECE, TableKind, TablePiece};
use heapless::Vec;

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

    /// Checks a table for a garment.
    fn check(self, table: &[u8], layout: &Layout) -> Result<(), Invalid> {
        match self {
            TableKind::Surface => Table::check(table, layout).map(drop),
            TableKind::Folds => FoldTable::check(table, layout).map(drop),
        }
    }
}

/// True if this build has a use for any table.
pub(super) const TABLES: bool = !TableKind::USED.is_empty();
/// Room for a piece; a build without tables has none.
const ROOM: usize = if TABLES { TABLE_PIECE } else { 0 };

/// A piece of a table, to be stored.
#[derive(Debug, Clone, Copy)]
pub struct PieceToStore<'a> {
    /// Content of the table.
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
struct Upload {
    kind: TableKind,
    length: u32,
    stored: u32,
    /// The table, once all of it is stored.
    whole: Option<&'static [u8]>,
}

/// The next table.
pub(super) struct Uploads {
    /// The table being received; a build without tables has no room for one.
    upload: [Option<Upload>; TABLES as usize],
    piece: Vec<u8, ROOM>,
}

/// Step that follows a piece that was taken, or stored.
pub(super) enum UploadStep {
    /// The piece is to be stored.
    Store,
    /// The table, all of which is stored, is to be kept; or none.
    Keep(TableKind),
    /// Another piece follows.
    More,
}

impl Uploads {
    pub const fn new() -> Uploads {
        Uploads { upload: [None; TABLES as usize], piece: Vec::new() }
    }

    fn upload(&self) -> Option<Upload> {
        self.upload.first().copied().flatten()
    }

    /// Takes a piece of a table. Error if it is not the next one, or if the first one may not be stored.
    #[inline(never)]
    pub fn take(
        &mut self,
        piece: &[u8],
        may_begin: impl FnOnce() -> Result<(), Refusal>,
    ) -> Result<UploadStep, Refusal> {
        let TablePiece { kind, length, offset, bytes } = reading::value("table", piece)?;
        if !TableKind::USED.contains(&kind) {
            let surface = kind == TableKind::Surface;
            return Err(Refusal::left_out(if surface { "surface" } else { "folds" }));
        }
        let most = kind.bytes();
        if length as usize > most {
            return Err(format_args!("the table has {length} bytes, and there is room for {most}").into());
        }
        if offset == 0 {
            may_begin()?;
            self.upload.fill(Some(Upload { kind, length, stored: 0, whole: None }));
        }
        let upload = self.upload().filter(|it| it.kind == kind);
        let Some(upload) = upload.filter(|it| it.length == length && it.stored == offset) else {
            let next = upload.map_or(0, |upload| upload.stored);
            return Err(format_args!("the next piece is the one from byte {next} on").into());
        };
        if length == 0 {
            return Ok(UploadStep::Keep(kind));
        }
        let left = (upload.length - upload.stored) as usize;
        self.piece.clear();
        if bytes.len() != left.min(TABLE_PIECE) || self.piece.extend_from_slice(bytes).is_err() {
            return Err(format_args!("a piece has {TABLE_PIECE} bytes, and the last one the rest").into());
        }
        Ok(UploadStep::Store)
    }

    /// The piece to be stored, with so many saves left after it.
    pub fn piece_to_store(&self, saves: u8) -> PieceToStore<'_> {
        let upload = self.upload();
        let (length, offset) = upload.map_or((0, 0), |upload| (upload.length, upload.stored));
        let kind = upload.map_or(TableKind::Surface, |upload| upload.kind);
        PieceToStore { kind, length, offset, bytes: &self.piece, saves }
    }

    /// True if the first piece is the one to be stored.
    pub fn is_first(&self) -> bool {
        self.upload().is_some_and(|upload| upload.stored == 0)
    }

    /// Takes the result of storing a piece: the whole table with the last one, which is checked for a garment.
    /// An error ends the upload. None if there is no upload.
    #[inline(never)]
    pub fn stored(
        &mut self,
        result: Result<Option<&'static [u8]>, &'static str>,
        layout: &Layout,
    ) -> Option<Result<UploadStep, Refusal>> {
        let mut upload = self.upload()?;
        upload.stored += self.piece.len() as u32;
        upload.whole = result.ok().flatten();
        self.upload.fill(Some(upload));
        let kind = upload.kind;
        let done = result.map_err(Refusal::of).and_then(|whole| match whole {
            Some(whole) => kind.check(whole, layout).map(|()| UploadStep::Keep(kind)).map_err(Refusal::of),
            None => Ok(UploadStep::More),
        });
        if done.is_err() {
            self.upload.fill(None);
        }
        Some(done)
    }

    /// Ends the upload; returns the table that was received.
    pub fn end(&mut self) -> Option<&'static [u8]> {
        let whole = self.upload().and_then(|upload| upload.whole);
        self.upload.fill(None);
        whole
    }
}
