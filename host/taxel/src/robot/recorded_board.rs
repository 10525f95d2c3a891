//! A board's part of a robot's recording, filled in the board's own thread: what goes from there to the
//! recorder's are whole chunks, packed.

use super::event::Teller;
use super::file::ReadRobot;
use super::scan::{BoardScan, ScanReader};
use crate::client::{Client, Event, Worn, request_name};
use crate::error::Result;
use crate::record::{BoardMessages, Origin, Stamp, Tally, Topics, attach};
use crate::recording::{FullChunk, HELLO, Store, Writer, attachment_of};
use crate::source::Source;
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
struct Described {
    worn: Worn,
    hello: Vec<u8>,
    origin: Origin,
    ns: u64,
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
    fn add(
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

    /// Counts an image.
    fn image(&mut self, stamp: Stamp) {
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

/// What a robot's recorder is told of an event of a board, whose messages are in the board's part already.
#[derive(Debug, Default, PartialEq)]
pub struct BoardRecord {
    /// Anything of the board is ready to be written.
    pub(super) is_ready: bool,
    /// The scan that it is about.
    pub scan: Option<BoardScan>,
    /// Why the board refuses a request.
    pub refusal: Option<String>,
}

/// Records a board's events.
#[derive(Debug)]
pub struct RecordTeller {
    board: SharedBoard,
    origin: Origin,
    worn: Option<Worn>,
    reader: ScanReader,
}

impl RecordTeller {
    /// Of this board of a robot.
    pub(super) fn new(robot: &ReadRobot, number: usize, board: SharedBoard) -> RecordTeller {
        let calibration = robot.boards.get(number).and_then(|board| board.calibration.clone());
        let origin = Origin { calibration, ..Origin::default() };
        RecordTeller { board, origin, worn: None, reader: ScanReader::new(robot, number) }
    }

    /// Adds the board's description, if it is new.
    fn describe(&mut self, client: &Client, stamp: Stamp) {
        if client.worn() == self.worn.as_ref() {
            return;
        }
        self.worn = client.worn().cloned();
        let described = self.worn.clone().map(|worn| Described {
            worn,
            hello: client.line().to_vec(),
            origin: self.origin.clone(),
            ns: stamp.host_ns(),
        });
        self.board.lock().described.extend(described);
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
        let scan = self.reader.scan(client, event);
        Ok(BoardRecord { is_ready, scan, refusal }.news())
    }

    fn note(&mut self, client: &Client, note: &Event, stamp: Stamp) -> Result<Option<BoardRecord>> {
        let is_ready = self.add(client, stamp, |messages| messages.event(client, note, stamp))?;
        Ok(BoardRecord { is_ready, ..BoardRecord::default() }.news())
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Option<BoardRecord>> {
        let is_ready = self.add(client, stamp, |messages| messages.requests(client, bytes, stamp))?;
        Ok(BoardRecord { is_ready, ..BoardRecord::default() }.news())
    }
}
