//! The very board on this host: requests, codes and a time in, bytes of its wire out. Nothing here waits, and nothing
//! reads a clock.

use super::beside::built;
use super::sim::{info as simulated_info, lasting};
use crate::error::{Result, UsageError};
use taxel_core::acquire::{Scan, ScanError, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job, PieceToStore, Shipped};
use taxel_core::boot::Boot;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::selftest::Findings;
use taxel_core::wire::{Request, encode, frame_bound};

/// Reason why settings are not kept.
const NO_FLASH: &str = "this board is code on the host and has no flash";
/// Jobs between two scans: pins to drive, and works that wait. A board never has that many.
const MOST_JOBS: usize = 1000;

/// Receiver of the bytes of the wire.
pub type WireSink<'a> = dyn FnMut(&[u8]) -> Result<()> + 'a;

/// The board for a garment: without a converter if the garment has no wiring, because its codes come from elsewhere.
fn info(garment: &Garment, firmware: &'static str) -> BoardInfo {
    let mut info = BoardInfo { firmware, ..simulated_info(garment) };
    if garment.blocks.is_empty() {
        info.pins.inputs = 0;
    }
    info
}

/// A board without pins, without a converter and without a clock.
pub struct SteppedBoard {
    board: Box<Shipped>,
    codes: Vec<Code>,
    /// The table being received.
    table: Vec<u8>,
    last: Option<Micros>,
    /// The board waits for a scan: also after one that was refused.
    is_due: bool,
}

impl SteppedBoard {
    /// A board as after power-up. Error if the garment or the scene does not fit it.
    pub fn new(garment: Garment, scene: Scene, firmware: &'static str) -> Result<SteppedBoard> {
        let mut board =
            built(move || Ok(Board::new(info(&garment, firmware), garment, scene).map(Box::new)?))?;
        board.booted(Boot::default());
        Ok(SteppedBoard { board, codes: Vec::new(), table: Vec::new(), last: None, is_due: false })
    }

    /// The board.
    pub fn board(&self) -> &Shipped {
        &self.board
    }

    /// Number of taxels: the length of a scan.
    pub fn taxels(&self) -> usize {
        self.board.setup().layout.taxels()
    }

    /// Begins a tare before anybody listens: the first frames are its baseline, whatever is asked for later.
    pub fn tare(&mut self, frames: u16, time: Micros) -> Result<()> {
        let mut room = [0; frame_bound(8)];
        let request = encode(&Request::Tare { frames }, &mut room)?;
        self.attend(request, time, &mut |_| Ok(()))
    }

    /// Passes requests, and does what waits. Error if the time is before the last one.
    pub(crate) fn attend(&mut self, requests: &[u8], time: Micros, sent: &mut WireSink<'_>) -> Result<()> {
        require!(
            self.last.is_none_or(|last| last <= time),
            UsageError::Argument,
            "a step at {} us is before the last one",
            time.0
        );
        let first = self.last.replace(time).is_none();
        if first {
            self.examined(time);
        }
        self.board.step(time, Input::Received(requests), &mut ());
        self.is_due |= self.work(time);
        self.send(time, sent)
    }

    /// Passes requests, then one scan, which started and ended at this time, with the codes of all taxels by their
    /// numbers; `missed` scans were lost before it. A scene with a rate of its own takes only the scans that are due.
    pub fn step(
        &mut self,
        requests: &[u8],
        codes: &[u16],
        missed: u32,
        time: Micros,
        sent: &mut WireSink<'_>,
    ) -> Result<()> {
        self.attend(requests, time, sent)?;
        // A request may just have changed the garment.
        let taxels = self.taxels();
        require!(
            codes.len() == taxels,
            UsageError::Argument,
            "{} codes for a garment of {taxels} taxels",
            codes.len()
        );
        if std::mem::take(&mut self.is_due) {
            self.codes.clear();
            self.codes.extend(codes.iter().map(|code| Code(*code)));
            let report = ScanReport { start: time, overruns: missed, ..ScanReport::default() };
            let scan = Scan { codes: &self.codes, report };
            self.board.step(time, Input::Scanned(Ok(scan)), &mut ());
            self.send(time, sent)?;
        }
        Ok(())
    }

    /// Counts a scan that failed, if one is due.
    pub fn fail(&mut self, time: Micros, sent: &mut WireSink<'_>) -> Result<()> {
        self.attend(&[], time, sent)?;
        if std::mem::take(&mut self.is_due) {
            self.board.step(time, Input::Scanned(Err(ScanError::OutOfStep)), &mut ());
        }
        self.send(time, sent)
    }

    /// Does the board's jobs until it wants a scan. False if no scan is due.
    fn work(&mut self, now: Micros) -> bool {
        for _ in 0..MOST_JOBS {
            let input = match self.board.step(now, Input::Tick, &mut ()) {
                Some(Job::Scan(_)) => return true,
                Some(Job::Save) => Input::Saved(Err(NO_FLASH)),
                Some(Job::ResetSettings { .. }) => Input::SettingsReset(Err(NO_FLASH)),
                Some(Job::StoreTable) => Input::TableStored(Ok(self.stored())),
                Some(Job::KeepTable(kind)) => Input::TableKept(kind, Ok(())),
                Some(Job::Examine) => {
                    self.examined(now);
                    continue;
                }
                // There are no pins, and a restart only follows stored settings.
                Some(Job::Drive(..) | Job::Restart) => continue,
                None => return false,
            };
            self.board.step(now, input, &mut ());
        }
        false
    }

    /// Takes a piece of a table; returns the table with its last piece.
    fn stored(&mut self) -> Option<&'static [u8]> {
        let PieceToStore { length, offset, bytes, .. } = self.board.piece_to_store();
        self.table.truncate(offset as usize);
        self.table.extend_from_slice(bytes);
        (self.table.len() == length as usize).then(|| lasting(&self.table))
    }

    /// All lines and inputs are good.
    fn examined(&mut self, now: Micros) {
        let inputs = info(&self.board.setup().garment, "").pins.inputs.count_ones() as u8;
        let lines = self.board.circuit().lines().len() as u8;
        let findings = Findings { lines, inputs, ..Findings::default() };
        self.board.step(now, Input::Examined(Ok(findings)), &mut ());
    }

    /// Takes all that the board sends.
    fn send(&mut self, now: Micros, sent: &mut WireSink<'_>) -> Result<()> {
        loop {
            let bytes = self.board.pending(now, &mut ());
            let count = bytes.len();
            if count == 0 {
                return Ok(());
            }
            sent(bytes)?;
            self.board.sent(count);
        }
    }
}
