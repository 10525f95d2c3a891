//! A board's stream for other programs: ask for one event after the other, or iterate.
//!
//! ```
//! use taxel::client::Event;
//! use taxel::session::Session;
//!
//! let session = Session::open("sim:pat")?;
//! let contacts = session.filter(|event| matches!(event, Ok(Event::Contacts { .. })));
//! assert!(contacts.take(3).count() == 3);
//! # Ok::<(), anyhow::Error>(())
//! ```

use crate::client::{Client, Event};
use crate::fault::{Blame, Fault};
use crate::source::{self, Source, SourceOptions, SourceSpec};
use anyhow::{Context, Result};
use taxel_core::wire::Request;

/// A board that streams. Dropping it lets the board go.
pub struct Session {
    source: Source,
    client: Client,
    buffer: Vec<u8>,
    taken: usize,
}

impl Session {
    /// Connects by the words of `--source` (`auto`, `usb`, `sim:pat`, `serial:/dev/ttyACM0`, `tcp:HOST:PORT` ...) and asks for
    /// everything, after a tare where a simulation wants one.
    pub fn open(source: &str) -> Result<Session> {
        let spec: SourceSpec =
            source.parse().map_err(|why| Fault::usage(format!("source {source}: {why}")))?;
        Session::over(source::open(&spec, &SourceOptions::default())?)
    }

    /// The same over a source that is open.
    pub fn over(source: Source) -> Result<Session> {
        let mut client = Client::new();
        client.start(source.tare)?;
        Ok(Session { source, client, buffer: Vec::new(), taken: 0 })
    }

    /// What is known now: image, contacts, intention, health.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// Asks the board for something; its answer is an [`Event::Answer`].
    pub fn request(&mut self, request: &Request<'_>) -> Result<()> {
        Ok(self.client.request(request)?)
    }

    /// What comes within the next short while (10 ms to a second, as the link is): none where nothing is whole yet.
    pub fn poll(&mut self) -> Result<Poll> {
        while let Some(byte) = self.buffer.get(self.taken) {
            self.taken += 1;
            if let Some(event) = self.client.push(*byte) {
                return Ok(Poll::Event(event));
            }
        }
        let lost = || format!("{} is gone", self.source.label);
        self.source.port.write(&self.client.take_requests()).with_context(lost).board()?;
        self.buffer.resize(4096, 0);
        let count = self.source.port.read(&mut self.buffer).with_context(lost).board()?;
        self.buffer.truncate(count.unwrap_or(0));
        self.taken = 0;
        Ok(if count.is_some() { Poll::Nothing } else { Poll::End })
    }

    /// Waits for the next event; none: the stream has ended. The [`client`](Session::client) is in the state after it.
    pub fn wait(&mut self) -> Result<Option<Event>> {
        loop {
            match self.poll()? {
                Poll::Event(event) => return Ok(Some(event)),
                Poll::Nothing => {}
                Poll::End => return Ok(None),
            }
        }
    }
}

/// What [`Session::poll`] found.
#[derive(Debug, Clone, PartialEq)]
pub enum Poll {
    /// An event.
    Event(Event),
    /// Nothing yet.
    Nothing,
    /// The stream has ended.
    End,
}

impl Iterator for Session {
    type Item = Result<Event>;

    fn next(&mut self) -> Option<Result<Event>> {
        self.wait().transpose()
    }
}
