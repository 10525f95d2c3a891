//! Tables that lie in flash: a table comes in pieces, and is stored beside the one of its kind in force.

use super::refusal::Refusal;
use super::uploads::{PieceToStore, TableKind, Upload};
use super::work::{FULL, Work};
use super::{Board, reading};
use crate::fold::FoldTable;
use crate::format::{Invalid, Micros};
use crate::surface::Table;
use crate::wire::{TABLE_PIECE, TablePiece};

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
            TableKind::Surface => self.surface.wear(table, &self.setup.layout, self.ledger.last()),
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
        let TablePiece { length, offset, bytes } = reading::value("table", piece)?;
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
        let number = Work::KeepTable(kind).request();
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
        self.outbox.answer(Work::KeepTable(kind).request(), result.err().map(Refusal::of));
    }

    fn table_worked(&mut self, now: Micros) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
    }

    /// Puts a table of folds in force, if it fits the present garment.
    #[cfg(feature = "folds")]
    fn wear_folds(&mut self, table: Option<&'static [u8]>) {
        self.folds.wear(table);
        self.refit_folds();
    }

    /// Garment or scene have changed.
    #[cfg(feature = "folds")]
    pub(super) fn refit_folds(&mut self) {
        let table = self.folds.fit(&self.setup.layout);
        self.state.condition.wear(table, &self.setup.scene.joints);
    }
}
