//! Tables that lie in flash: a table comes in pieces, and is stored beside the one of its kind in force.

use super::refusal::Refusal;
use super::{Board, Work, request};
use crate::capacity;
use crate::fold::{CELLS, FOLDED, FOLDS, FoldTable, fold_table_bytes};
use crate::format::{Invalid, Micros};
use crate::surface::{Table, table_bytes};
use crate::wire::{TABLE_PIECE, TablePiece};
use heapless::Vec;

/// What a table in flash holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableKind {
    /// Where the taxels lie, see [`Table`].
    Surface,
    /// What the garment's folds press, see [`FoldTable`].
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
    #[cfg(any(feature = "surface", feature = "folds"))]
    piece: Vec<u8, TABLE_PIECE>,
    #[cfg(not(any(feature = "surface", feature = "folds")))]
    piece: Vec<u8, 0>,
}

impl Uploads {
    pub const fn new() -> Uploads {
        Uploads { upload: [None; TABLES as usize], piece: Vec::new() }
    }

    /// What the table being received, or received last, holds.
    pub fn kind(&self) -> TableKind {
        self.upload().map_or(TableKind::Surface, |upload| upload.kind)
    }

    fn upload(&self) -> Option<Upload> {
        self.upload.first().copied().flatten()
    }

    fn set(&mut self, upload: Option<Upload>) {
        self.upload.fill(upload);
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Gives the board a table that its flash holds, after its garment and scene.
    pub fn recall_table(&mut self, kind: TableKind, table: Option<&'static [u8]>) {
        if TableKind::USED.contains(&kind) {
            self.wear(kind, table);
        }
    }

    /// Puts a table in force, if it fits the present garment.
    fn wear(&mut self, kind: TableKind, table: Option<&'static [u8]>) {
        match kind {
            TableKind::Surface => self.surface.wear(table, &self.setup.layout),
            #[cfg(feature = "folds")]
            TableKind::Folds => self.wear_folds(table),
            #[cfg(not(feature = "folds"))]
            TableKind::Folds => {}
        }
    }

    /// Checks a table for the present garment.
    fn check_table(&self, kind: TableKind, table: &[u8]) -> Result<(), Invalid> {
        match kind {
            TableKind::Surface => Table::check(table, &self.setup.layout).map(drop),
            TableKind::Folds => FoldTable::check(table, &self.setup.layout).map(drop),
        }
    }

    /// Takes a piece of a table. Error if it is not the next one. It is answered once it is stored.
    #[inline(never)]
    pub(super) fn take_table(&mut self, now: Micros, kind: TableKind, piece: &[u8]) -> Result<(), Refusal> {
        let TablePiece { length, offset, bytes } = request::read("table", piece)?;
        if self.works.iter().any(|work| matches!(work, Work::StoreTable | Work::KeepTable(_))) {
            return Err(Refusal::of("the last piece is not stored yet"));
        }
        let most = kind.bytes();
        if length as usize > most {
            return Err(format_args!("the table has {length} bytes, and there is room for {most}").into());
        }
        if offset == 0 {
            self.save(now)?;
            if self.is_busy() {
                return Err(Refusal::of("something touches the garment"));
            }
            self.uploads.set(Some(Upload { kind, length, stored: 0, whole: None }));
        }
        let upload = self.uploads.upload().filter(|it| it.kind == kind);
        let Some(upload) = upload.filter(|it| it.length == length && it.stored == offset) else {
            let next = upload.map_or(0, |upload| upload.stored);
            return Err(format_args!("the next piece is the one from byte {next} on").into());
        };
        if length == 0 {
            self.works.push_back(Work::KeepTable(kind)).map_err(|_| Refusal::of(FULL))?;
            return Ok(());
        }
        let left = (upload.length - upload.stored) as usize;
        if bytes.len() != left.min(TABLE_PIECE) {
            return Err(format_args!("a piece has {TABLE_PIECE} bytes, and the last one the rest").into());
        }
        self.uploads.piece.clear();
        self.uploads.piece.extend_from_slice(bytes).map_err(|_| Refusal::of(FULL))?;
        self.works.push_back(Work::StoreTable).map_err(|_| Refusal::of(FULL))
    }

    /// The piece to be stored.
    pub fn piece_to_store(&self) -> PieceToStore<'_> {
        let (upload, piece) = (self.uploads.upload(), &self.uploads.piece);
        let (length, offset) = upload.map_or((0, 0), |upload| (upload.length, upload.stored));
        let saves = self.saving.left_after();
        PieceToStore { kind: self.uploads.kind(), length, offset, bytes: piece, saves }
    }

    /// Takes the result of storing a piece: the whole table with the last one.
    #[inline(never)]
    pub(super) fn table_stored(&mut self, now: Micros, result: Result<Option<&'static [u8]>, &'static str>) {
        self.table_worked(now);
        let kind = self.uploads.kind();
        let Some(mut upload) = self.uploads.upload() else { return };
        if upload.stored == 0 {
            self.saving.charge(now);
        }
        upload.stored += self.uploads.piece.len() as u32;
        upload.whole = result.ok().flatten();
        self.uploads.set(Some(upload));
        let checked = result.map_err(Refusal::of).and_then(|whole| {
            whole.map(|whole| self.check_table(kind, whole).map_err(Refusal::of)).transpose()
        });
        let number = request::number_of(Work::KeepTable(kind));
        match checked {
            // It is answered once the table is kept.
            Ok(Some(())) if self.works.push_back(Work::KeepTable(kind)).is_ok() => {}
            Ok(None) => self.outbox.answer(number, None),
            refused => {
                self.uploads.set(None);
                let why = refused.err().unwrap_or_else(|| Refusal::of(FULL));
                self.outbox.answer(number, Some(why));
            }
        }
    }

    /// Takes the result of keeping the table that was stored last, or none.
    #[inline(never)]
    pub(super) fn table_kept(&mut self, now: Micros, kind: TableKind, result: Result<(), &'static str>) {
        self.table_worked(now);
        let upload = self.uploads.upload();
        self.uploads.set(None);
        if result.is_ok() {
            self.wear(kind, upload.and_then(|upload| upload.whole));
        }
        self.outbox.answer(request::number_of(Work::KeepTable(kind)), result.err().map(Refusal::of));
    }

    fn table_worked(&mut self, now: Micros) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
    }
}

/// Refusal of work.
const FULL: &str = "too much is waiting to be done";
