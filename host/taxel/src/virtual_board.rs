//! The very board, stepped by hand: the codes of a scan and a time in, events out. For simulators that make
//! codes of their own, and for tests. Nothing here waits, and nothing reads a clock.
//!
//! ```
//! use taxel::client::Event;
//! use taxel::virtual_board::VirtualBoard;
//! use taxel_core::format::Micros;
//! use taxel_core::garment::Garment;
//! use taxel_core::scene::Scene;
//! use taxel_core::wire::Request;
//!
//! let mut board = VirtualBoard::new(Garment::block(), Scene::shipped())?;
//! board.client().request(&Request::Tare { frames: 8 })?;
//! let mut touched = 0;
//! for frame in 0..30 {
//!     let mut codes = vec![100; board.taxels()];
//!     if frame > 19 {
//!         codes[20..24].fill(900);
//!     }
//!     board.step(&codes, Micros(frame * 5_000), &mut |client, event| {
//!         touched += usize::from(matches!(event, Event::Frame { .. }) && !client.contacts().is_empty());
//!         Ok(())
//!     })?;
//! }
//! assert!((6..=10).contains(&touched), "only the touch");
//! # Ok::<(), taxel::Error>(())
//! ```

use crate::client::{Client, Event};
use crate::error::{Context, Result, SourceError, UsageError};
use crate::source::{lasting, simulated_info};
use std::thread;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job, PieceToStore, Shipped};
use taxel_core::boot::Boot;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Area, Garment};
use taxel_core::scene::Scene;
use taxel_core::selftest::Findings;

/// A board is boxed, but built on the stack.
const STACK: usize = 8 << 20;
/// Reason why settings are not kept.
const NO_FLASH: &str = "a board that is stepped by hand has no flash";
/// Jobs between two scans: pins to drive, and works that wait. A board never has that many.
const MOST_JOBS: usize = 1000;

/// Receives an event; the client already includes it. [`Error::other`](crate::Error::other) holds an error of
/// its own.
pub type EventSink<'a> = dyn FnMut(&Client, &Event) -> Result<()> + 'a;

/// The board for a garment: without a converter if the garment has no wiring, because its codes come from elsewhere.
fn info(garment: &Garment) -> BoardInfo {
    let mut info = simulated_info(garment);
    if garment.blocks.is_empty() {
        info.pins.inputs = 0;
    }
    info
}

/// A board without pins, without a converter and without a clock.
pub struct VirtualBoard {
    board: Box<Shipped>,
    client: Client,
    codes: Vec<Code>,
    /// The table being received.
    table: Vec<u8>,
    last: Option<Micros>,
    /// The board waits for a scan: also after one that was refused.
    is_due: bool,
}

impl VirtualBoard {
    /// A board as after power-up, whose whole stream is requested. Error if the garment or the scene does not
    /// fit the board.
    pub fn new(garment: Garment, scene: Scene) -> Result<VirtualBoard> {
        let build = move || Board::new(info(&garment), garment, scene).map(Box::new);
        let builder = thread::Builder::new().name("board".into()).stack_size(STACK).spawn(build)?;
        let mut board =
            builder.join().map_err(|_| error!(SourceError::Unstarted, "the board could not be built"))??;
        board.booted(Boot::default());
        let mut client = Client::new();
        client.start(0)?;
        Ok(VirtualBoard { board, client, codes: Vec::new(), table: Vec::new(), last: None, is_due: false })
    }

    /// Number of taxels: the length of a scan.
    pub fn taxels(&self) -> usize {
        self.board.setup().layout.taxels()
    }

    /// The taxels that fold: number, expected pressure and doubt of it, counts.
    pub fn folds(&self) -> Vec<[u16; 3]> {
        let folds = self.board.state().condition.folds();
        let taxels =
            folds.table().into_iter().flat_map(|table| table.folded()).flat_map(|(_, taxels)| taxels);
        let reported = |taxel: &u16| folds.of(*taxel).map(|[expected, doubt]| [*taxel, expected, doubt]);
        taxels.filter_map(reported).collect()
    }

    /// Panels of the garment.
    pub fn areas(&self) -> &[Area] {
        self.board.setup().layout.areas()
    }

    /// The client, for requests; they reach the board with the next step.
    pub fn client(&mut self) -> &mut Client {
        &mut self.client
    }

    /// One scan, which started and ended at this time, with the codes of all taxels by their numbers. Hands
    /// over the events that it causes. A scene with a rate of its own takes only the scans that are due.
    pub fn step(&mut self, codes: &[u16], time: Micros, reported: &mut EventSink<'_>) -> Result<()> {
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
        let requests = self.client.take_requests();
        self.board.step(time, Input::Received(&requests), &mut ());
        self.is_due |= self.work(time);
        self.send(time, reported)?;
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
            let report = ScanReport { start: time, ..ScanReport::default() };
            let scan = Scan { codes: &self.codes, report };
            self.board.step(time, Input::Scanned(Ok(scan)), &mut ());
            self.send(time, reported)?;
        }
        Ok(())
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
        let inputs = info(&self.board.setup().garment).pins.inputs.count_ones() as u8;
        let lines = self.board.circuit().lines().len() as u8;
        let findings = Findings { lines, inputs, ..Findings::default() };
        self.board.step(now, Input::Examined(Ok(findings)), &mut ());
    }

    /// Takes all that the board sends.
    fn send(&mut self, now: Micros, reported: &mut EventSink<'_>) -> Result<()> {
        loop {
            let bytes = self.board.pending(now, &mut ());
            let count = bytes.len();
            if count == 0 {
                return Ok(());
            }
            for byte in bytes {
                if let Some(event) = self.client.push(*byte) {
                    reported(&self.client, &event).context("an event could not be handed over")?;
                }
            }
            self.board.sent(count);
        }
    }
}
