//! Records a board of a robot, in the board's own thread.

use super::event::Teller;
use super::recorded_board::{Described, SharedBoard};
use crate::client::{Client, Event, Worn, request_name};
use crate::error::Result;
use crate::files::calibrate::Calibration;
use crate::record::{BoardMessages, Origin, Stamp};
use crate::source::Source;

/// What a robot's recorder is told of an event of a board, whose messages are in the board's part already.
#[derive(Debug, Default, PartialEq)]
pub struct BoardRecord {
    /// Anything of the board is ready to be written.
    pub(super) is_ready: bool,
    /// Why the board refuses a request.
    pub refusal: Option<String>,
}

/// Records a board's events.
#[derive(Debug)]
pub struct RecordTeller {
    board: SharedBoard,
    origin: Origin,
    worn: Option<Worn>,
}

impl RecordTeller {
    /// Of a board that has this calibration.
    pub(super) fn new(board: SharedBoard, calibration: Option<Calibration>) -> RecordTeller {
        let origin = Origin { calibration, ..Origin::default() };
        RecordTeller { board, origin, worn: None }
    }

    /// Adds the board's description, if it is new.
    fn describe(&mut self, client: &Client, stamp: Stamp) {
        if client.worn() == self.worn.as_ref() {
            return;
        }
        self.worn = client.worn().cloned();
        let Some(worn) = self.worn.clone() else { return };
        let (hello, origin) = (client.line().to_vec(), self.origin.clone());
        self.board.lock().describe(Described { worn, hello, origin, ns: stamp.host_ns() });
    }

    /// Adds messages. Returns true if anything is ready to be written.
    fn add(
        &self,
        client: &Client,
        stamp: Stamp,
        messages: impl FnOnce(&mut BoardMessages) -> Result<()>,
    ) -> Result<bool> {
        self.board.lock().add(client, stamp, messages)
    }
}

impl BoardRecord {
    /// None if the recorder need not be told: each record wakes its thread and takes a place in the queue. Once
    /// anything is ready to be written, every event is told, so that a slow disk holds the board back.
    fn news(self) -> Option<BoardRecord> {
        (self != BoardRecord::default()).then_some(self)
    }
}

impl Teller<BoardRecord> for RecordTeller {
    fn opened(&mut self, source: &Source) {
        self.origin.label.clone_from(&source.label);
        self.origin.counts_per_newton = source.counts_per_newton;
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<BoardRecord>> {
        if *event == Event::Hello {
            self.describe(client, stamp);
        }
        if matches!(event, Event::Frame { .. }) {
            self.board.lock().image(stamp);
        }
        let is_ready = self.add(client, stamp, |messages| {
            messages.frames(client, stamp)?;
            messages.event(client, event, stamp)
        })?;
        let refusal = match event {
            Event::Answer { request, refusal: Some(why) } => {
                Some(format!("the board refuses {}: {why}", request_name(*request)))
            }
            _ => None,
        };
        Ok(BoardRecord { is_ready, refusal }.news())
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Option<BoardRecord>> {
        let is_ready = self.add(client, stamp, |messages| messages.requests(client, bytes, stamp))?;
        Ok(BoardRecord { is_ready, ..BoardRecord::default() }.news())
    }
}
