//! The garment's surface: its table comes in pieces and is stored beside the one in force; what presses on
//! the robot is told at a rate of its own.

use super::pace::Pace;
use super::refusal::Refusal;
use super::{Board, Work, request};
use crate::capacity;
use crate::format::{Micros, Name};
use crate::garment::Layout;
use crate::pipeline::CONTACTS;
use crate::surface::{LINKS, Pose, Pressing, SurfaceState, Table, table_bytes};
use crate::wire::{PressingReport, SURFACE_PIECE, TablePiece};
use heapless::Vec;

/// Longest table: that of a garment of [`capacity::TAXELS`] taxels.
pub const SURFACE_BYTES: usize = table_bytes(capacity::TAXELS);

/// A piece of a table, to be stored.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePiece<'a> {
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
    length: u32,
    stored: u32,
    /// The table, once all of it is stored.
    whole: Option<&'static [u8]>,
}

/// The surface in force, and the next one.
pub(super) struct Surface {
    /// The stored table, and whether it fits the present garment.
    table: Option<&'static [u8]>,
    fits: bool,
    upload: Option<Upload>,
    #[cfg(feature = "surface")]
    piece: Vec<u8, SURFACE_PIECE>,
    #[cfg(not(feature = "surface"))]
    piece: Vec<u8, 0>,
    poses: SurfaceState,
    rate: Pace,
    /// Frame to tell of.
    due: Option<(u32, Micros)>,
    /// True if the last report told of something.
    told: bool,
}

impl Surface {
    pub const fn new() -> Surface {
        Surface {
            table: None,
            fits: false,
            upload: None,
            piece: Vec::new(),
            poses: SurfaceState::new(),
            rate: Pace::NEVER,
            due: None,
            told: false,
        }
    }

    /// The table in force.
    pub fn table(&self) -> Option<Table<'static>> {
        if cfg!(feature = "surface") && self.fits { Table::view(self.table?) } else { None }
    }

    /// Puts a table in force if it fits the garment; forgets poses, which are of the links of another.
    fn wear(&mut self, table: Option<&'static [u8]>, layout: &Layout) {
        self.table = table;
        self.fits = table.is_some_and(|table| Table::check(table, layout).is_ok());
        self.poses = SurfaceState::new();
    }

    /// Another garment is worn.
    pub fn refit(&mut self, layout: &Layout) {
        if cfg!(feature = "surface") {
            self.wear(self.table, layout);
        }
    }

    /// Notes a frame to tell of: when something touches, and once when nothing does any more.
    pub fn note(&mut self, frame: u32, time: Micros, touched: bool) {
        if self.table().is_none() || !(touched || self.told) {
            return;
        }
        if self.rate.due(time) || self.due.is_some() {
            self.due = Some((frame, time));
        }
    }

    /// Report that is due. `press` makes it of a table.
    pub fn report(
        &mut self,
        press: impl FnOnce(&Table<'_>, &SurfaceState) -> Pressing<CONTACTS>,
    ) -> Option<PressingReport> {
        let (frame, time) = self.due.take()?;
        let table = self.table()?;
        let Pressing { contacts, links } = press(&table, &self.poses);
        self.told = !contacts.is_empty();
        Some(PressingReport { frame, time, posed: self.poses.told(), contacts, links })
    }

    /// True if a report is due.
    pub fn is_due(&self) -> bool {
        self.due.is_some()
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Gives the board the table that its flash holds, after its garment.
    pub fn recall_surface(&mut self, table: Option<&'static [u8]>) {
        if cfg!(feature = "surface") {
            self.surface.wear(table, &self.setup.layout);
        }
    }

    /// The surface in force.
    pub fn surface(&self) -> Option<Table<'static>> {
        self.surface.table()
    }

    /// Takes a piece of a table. Error if it is not the next one. It is answered once it is stored.
    #[inline(never)]
    pub(super) fn take_surface(&mut self, now: Micros, piece: &[u8]) -> Result<(), Refusal> {
        let TablePiece { length, offset, bytes } = request::read("surface", piece)?;
        if self.works.iter().any(|work| matches!(work, Work::StoreSurface | Work::KeepSurface)) {
            return Err(Refusal::of("the last piece is not stored yet"));
        }
        if length as usize > SURFACE_BYTES {
            let most = SURFACE_BYTES;
            return Err(format_args!("the table has {length} bytes, and there is room for {most}").into());
        }
        if offset == 0 {
            self.save(now)?;
            if self.is_busy() {
                return Err(Refusal::of("something touches the garment"));
            }
            self.surface.upload = Some(Upload { length, stored: 0, whole: None });
        }
        let Some(upload) = self.surface.upload.filter(|it| it.length == length && it.stored == offset) else {
            let next = self.surface.upload.map_or(0, |upload| upload.stored);
            return Err(format_args!("the next piece is the one from byte {next} on").into());
        };
        if length == 0 {
            self.works.push_back(Work::KeepSurface).map_err(|_| Refusal::of(FULL))?;
            return Ok(());
        }
        let left = (upload.length - upload.stored) as usize;
        if bytes.len() != left.min(SURFACE_PIECE) {
            return Err(format_args!("a piece has {SURFACE_PIECE} bytes, and the last one the rest").into());
        }
        self.surface.piece.clear();
        self.surface.piece.extend_from_slice(bytes).map_err(|_| Refusal::of(FULL))?;
        self.works.push_back(Work::StoreSurface).map_err(|_| Refusal::of(FULL))
    }

    /// The piece to be stored.
    pub fn surface_piece(&self) -> SurfacePiece<'_> {
        let (length, offset) = self.surface.upload.map_or((0, 0), |upload| (upload.length, upload.stored));
        SurfacePiece { length, offset, bytes: &self.surface.piece, saves: self.saving.left_after() }
    }

    /// Takes the result of storing a piece: the whole table with the last one.
    #[inline(never)]
    pub(super) fn surface_stored(
        &mut self,
        now: Micros,
        result: Result<Option<&'static [u8]>, &'static str>,
    ) {
        if !cfg!(feature = "surface") {
            return;
        }
        self.surface_worked(now);
        let Some(upload) = self.surface.upload.as_mut() else { return };
        if upload.stored == 0 {
            self.saving.charge(now);
        }
        upload.stored += self.surface.piece.len() as u32;
        upload.whole = result.ok().flatten();
        let checked = result.map_err(Refusal::of).and_then(|whole| {
            whole
                .map(|whole| Table::check(whole, &self.setup.layout).map(drop).map_err(Refusal::of))
                .transpose()
        });
        match checked {
            // It is answered once the table is kept.
            Ok(Some(())) if self.works.push_back(Work::KeepSurface).is_ok() => {}
            Ok(None) => self.outbox.answer(request::number_of(Work::KeepSurface), None),
            refused => {
                self.surface.upload = None;
                let why = refused.err().unwrap_or_else(|| Refusal::of(FULL));
                self.outbox.answer(request::number_of(Work::KeepSurface), Some(why));
            }
        }
    }

    /// Takes the result of keeping the table that was stored last, or none.
    #[inline(never)]
    pub(super) fn surface_kept(&mut self, now: Micros, result: Result<(), &'static str>) {
        if !cfg!(feature = "surface") {
            return;
        }
        self.surface_worked(now);
        let upload = self.surface.upload.take();
        if result.is_ok() {
            self.surface.wear(upload.and_then(|upload| upload.whole), &self.setup.layout);
        }
        self.outbox.answer(request::number_of(Work::KeepSurface), result.err().map(Refusal::of));
    }

    fn surface_worked(&mut self, now: Micros) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
    }

    /// Takes poses of links.
    #[inline(never)]
    pub(super) fn take_poses(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let table = self.surface.table().ok_or_else(|| Refusal::of(NO_SURFACE))?;
        let poses = request::read::<Vec<(Name, Pose), LINKS>>("poses", bytes)?;
        self.surface.poses.accept(&poses, &table, now).map_err(Refusal::of)
    }

    /// Sets the rate of reports of what presses on the robot.
    #[inline(never)]
    pub(super) fn tell_pressing(&mut self, hz: u16) -> Result<(), Refusal> {
        if hz > 0 && self.surface.table().is_none() {
            return Err(Refusal::of(NO_SURFACE));
        }
        self.surface.rate = Pace::new(hz);
        self.surface.due = None;
        Ok(())
    }
}

/// Refusal of work.
const FULL: &str = "too much is waiting to be done";

/// Refusal without a table.
const NO_SURFACE: &str = "no surface is in force";
