//! A board's part of a robot's recording, filled in the board's own thread: what goes from there to the recorder
//! are whole chunks, packed.

use crate::client::{Client, Worn};
use crate::error::Result;
use crate::record::{BoardMessages, Origin, Stamp, Tally, Topics, attach};
use crate::recording::{FullChunk, HELLO, Store, Writer, attachment_of};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most time of a board between two chunks, us, so that readers can seek to any second.
const CHUNK_US: u64 = 1_000_000;

/// What is recorded of a board.
#[derive(Debug)]
pub struct RecordedBoard {
    messages: BoardMessages,
    described: Vec<Described>,
    /// Its counters so far.
    pub tally: Tally,
    /// Host time of the first message in the chunk, us.
    chunk_us: Option<u64>,
    /// Host times of its first and last image, us.
    pub frames_us: Option<[u64; 2]>,
}

/// A board's description, and the frame of its `Hello`.
#[derive(Debug)]
pub struct Described {
    /// What it wears.
    pub worn: Worn,
    /// The frame.
    pub hello: Vec<u8>,
    /// Where the stream comes from.
    pub origin: Origin,
    /// Host time, ns.
    pub ns: u64,
}

/// What is ready to be written of a board.
#[derive(Debug)]
pub struct Filled {
    described: Vec<Described>,
    full: Vec<FullChunk>,
}

/// A board's part of a recording, for its thread and for that of the recorder.
#[derive(Debug, Clone)]
pub struct SharedBoard(Arc<Mutex<RecordedBoard>>);

impl SharedBoard {
    /// Declares the topics of the board of this name.
    pub fn open<S: Store>(writer: &mut Writer<S>, name: &str) -> Result<SharedBoard> {
        let messages = BoardMessages::new(Topics::open(writer, Some(name))?);
        Ok(SharedBoard(Arc::new(Mutex::new(RecordedBoard {
            messages,
            described: Vec::new(),
            tally: Tally::default(),
            chunk_us: None,
            frames_us: None,
        }))))
    }

    /// The board's part. A panic of another thread does not poison it.
    pub fn lock(&self) -> MutexGuard<'_, RecordedBoard> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl RecordedBoard {
    /// Adds messages of one time. Returns true if anything is ready to be written.
    pub fn add(
        &mut self,
        client: &Client,
        stamp: Stamp,
        messages: impl FnOnce(&mut BoardMessages) -> Result<()>,
    ) -> Result<bool> {
        self.tally = Tally::of(client.counts());
        messages(&mut self.messages)?;
        // By each board's own course: simulations run ahead of each other.
        if stamp.host_us.abs_diff(*self.chunk_us.get_or_insert(stamp.host_us)) >= CHUNK_US {
            self.end_chunk();
        }
        Ok(self.messages.is_ready() || !self.described.is_empty())
    }

    /// Adds the board's description.
    pub fn describe(&mut self, described: Described) {
        self.described.push(described);
    }

    /// Counts an image.
    pub fn image(&mut self, stamp: Stamp) {
        let first = self.frames_us.map_or(stamp.host_us, |[first, _]| first);
        self.frames_us = Some([first, stamp.host_us]);
    }

    /// Ends the chunk: readers can seek to the next one.
    pub fn end_chunk(&mut self) {
        self.chunk_us = None;
        self.messages.close();
    }

    /// Takes what is ready to be written.
    pub fn take(&mut self) -> Filled {
        Filled { described: std::mem::take(&mut self.described), full: self.messages.take() }
    }
}

impl Filled {
    /// Writes it, of the board of this name.
    pub fn write<S: Store>(self, writer: &mut Writer<S>, name: &str, says_what: &mut bool) -> Result<()> {
        for Described { worn, hello, origin, ns } in self.described {
            if !std::mem::replace(says_what, true) {
                let hello_name = attachment_of(Some(name), HELLO);
                writer.attach(&hello_name, "application/octet-stream", &hello, ns)?;
            }
            attach(writer, &worn, &origin, ns, Some(name))?;
        }
        writer.write(self.full)
    }
}
