//! Part that a page can save as a recording: the last half minute of a board, or a part of a recording.

use anyhow::Result;
use std::sync::Arc;
use taxel::client::clock::SteadyTime;
use taxel::client::{BoardDescription, Client, Event, Stamp, time_of};
use taxel::record::{BoardPart, Origin, RecordingFile};
use taxel::recording::Store;
use taxel_core::format::Micros;

/// Board time per chunk, us.
const CHUNK_US: u64 = 1_000_000;

/// A recording, of which a part can be saved.
pub trait Saved: Send + Sync {
    /// Writes everything from the last image at the time `from` to the time `to`, us.
    fn write(&self, range: [u64; 2], store: &mut dyn Store) -> Result<()>;
}

/// Origin of what is saved.
#[derive(Clone)]
pub enum Tape {
    /// A board.
    Live(Arc<Origin>),
    /// A recording.
    Recorded(Arc<dyn Saved>),
}

/// A recording written frame by frame.
pub struct Copy<S: Store> {
    file: RecordingFile<S>,
    part: BoardPart,
    client: Client,
    origin: Origin,
    description: Option<BoardDescription>,
    chunk_us: u64,
}

impl<S: Store> Copy<S> {
    /// Begins the recording.
    pub fn begin(store: S, origin: Origin) -> Result<Copy<S>> {
        let mut file = RecordingFile::create(store, None)?;
        let part = file.board(None, None)?;
        let mut client = Client::new();
        client.weigh_by(origin.scale.clone());
        Ok(Copy { file, part, client, origin, description: None, chunk_us: 0 })
    }

    /// Adds a frame of the wire.
    #[cfg(feature = "program")]
    pub fn take(&mut self, stamp: Stamp, frame: &[u8]) -> Result<()> {
        match self.client.push_all(frame).1 {
            Some(event) => self.keep(stamp, &event),
            None => Ok(()),
        }
    }

    /// Writes the client's latest event.
    fn keep(&mut self, stamp: Stamp, event: &Event) -> Result<()> {
        self.client.take_requests();
        if *event == Event::Hello && self.client.description() != self.description.as_ref() {
            self.description = self.client.description().cloned();
            if let Some(description) = &self.description {
                self.file.attach(&mut self.part, description, self.client.line(), &self.origin, stamp)?;
            }
        }
        if stamp.board_us.abs_diff(self.chunk_us) >= CHUNK_US {
            self.chunk_us = stamp.board_us;
            self.part.close();
        }
        self.part.put(|messages| messages.frames(&self.client, stamp))?;
        self.part.event(&self.client, event, stamp)?;
        Ok(self.file.write(&mut self.part)?)
    }

    /// Writes the end.
    pub fn finish(mut self) -> Result<()> {
        self.part.close();
        self.file.write(&mut self.part)?;
        Ok(self.file.finish().map(drop)?)
    }
}

/// Writes the received bytes of a board as a recording; `newest` is the time of their last image.
pub fn live<S: Store>(bytes: &[u8], newest: Micros, origin: Origin, store: S) -> Result<()> {
    let mut copy = Copy::begin(store, origin)?;
    let now = SteadyTime::start().now_us();
    let mut board_us = newest.0;
    for byte in bytes {
        let Some(event) = copy.client.push(*byte) else { continue };
        board_us = time_of(&copy.client, &event).unwrap_or(board_us);
        let host_us = now.saturating_sub(newest.0.saturating_sub(board_us));
        copy.keep(Stamp { board_us, host_us, uncertainty_us: None }, &event)?;
    }
    copy.finish()
}
