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

use crate::client::{Client, Event, SIMULATED};
use crate::error::{Context, Result};
use crate::source::SteppedBoard;
use taxel_core::format::Micros;
use taxel_core::garment::{Area, Garment};
use taxel_core::scene::Scene;

/// Receives an event; the client already includes it. [`Error::other`](crate::Error::other) holds an error of
/// its own.
pub type EventSink<'a> = dyn FnMut(&Client, &Event) -> Result<()> + 'a;

/// A board without pins, without a converter and without a clock, and its client.
pub struct VirtualBoard {
    stepped: SteppedBoard,
    client: Client,
}

impl VirtualBoard {
    /// A board as after power-up, whose whole stream is requested. Error if the garment or the scene does not
    /// fit the board.
    pub fn new(garment: Garment, scene: Scene) -> Result<VirtualBoard> {
        let stepped = SteppedBoard::new(garment, scene, SIMULATED)?;
        let mut client = Client::new();
        client.start(0)?;
        Ok(VirtualBoard { stepped, client })
    }

    /// Number of taxels: the length of a scan.
    pub fn taxels(&self) -> usize {
        self.stepped.taxels()
    }

    /// The taxels that fold: number, expected pressure and doubt of it, counts.
    pub fn folds(&self) -> Vec<[u16; 3]> {
        let folds = self.stepped.board().state().condition.folds();
        let taxels =
            folds.table().into_iter().flat_map(|table| table.folded()).flat_map(|(_, taxels)| taxels);
        let reported = |taxel: &u16| folds.of(*taxel).map(|[expected, doubt]| [*taxel, expected, doubt]);
        taxels.filter_map(reported).collect()
    }

    /// Panels of the garment.
    pub fn areas(&self) -> &[Area] {
        self.stepped.board().setup().layout.areas()
    }

    /// The client, for requests; they reach the board with the next step.
    pub fn client(&mut self) -> &mut Client {
        &mut self.client
    }

    /// One scan, which started and ended at this time, with the codes of all taxels by their numbers. Hands
    /// over the events that it causes. A scene with a rate of its own takes only the scans that are due.
    pub fn step(&mut self, codes: &[u16], time: Micros, reported: &mut EventSink<'_>) -> Result<()> {
        let VirtualBoard { stepped, client } = self;
        let requests = client.take_requests();
        stepped.step(&requests, codes, 0, time, &mut |bytes| {
            for byte in bytes {
                if let Some(event) = client.push(*byte) {
                    reported(client, &event).context("an event could not be handed over")?;
                }
            }
            Ok(())
        })
    }
}
