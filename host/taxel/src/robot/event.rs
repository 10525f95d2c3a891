//! Events of a robot: what its boards say, and how they are.

use crate::client::{Client, Event};
use crate::error::{Error, Result};
use crate::record::Stamp;
use crate::source::Source;
use std::time::Duration;

/// An event of one of a robot's boards.
#[derive(Debug)]
pub struct RobotEvent<T> {
    /// Number of the board.
    pub board: usize,
    /// When it was: the host's time, which all boards share, its uncertainty, and the board's own.
    pub stamp: Stamp,
    /// What it is.
    pub what: BoardEvent<T>,
}

/// What a board says, or how it is.
#[derive(Debug)]
pub enum BoardEvent<T> {
    /// What a [`Teller`] has made of an event of the board.
    News(T),
    /// It is not there at the start, and is waited for.
    Absent {
        /// Why it cannot be opened.
        why: String,
    },
    /// It is recognised for the first time.
    Met,
    /// It is lost, and is waited for; the other boards go on.
    Lost {
        /// When it was last heard, the host's time, us since 1970.
        since_us: u64,
        /// Why.
        why: String,
    },
    /// It is back and recognised, and its settings are restored.
    Back {
        /// How long it was gone.
        after: Duration,
    },
    /// Another board answers in its place. Nothing that it sends is passed on.
    Other {
        /// How it differs.
        why: String,
    },
    /// Images were dropped, because whoever takes the events did not keep up.
    Dropped {
        /// Number of images of this board dropped so far.
        images: u64,
    },
    /// Its simulation or recording is over.
    Over,
    /// It cannot be followed any longer, for example because it refuses what it had accepted before.
    Failed(Error),
}

/// Makes of a board's events what a robot's stream is to hold, in the board's own thread.
pub trait Teller<T>: Send {
    /// Its source is open, and everything else follows.
    fn opened(&mut self, _source: &Source) {}

    /// Of an event, which the client already includes; none if it is not wanted.
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<T>>;

    /// Of requests that are sent to the board, as bytes.
    fn asked(&mut self, _client: &Client, _bytes: &[u8], _stamp: Stamp) -> Result<Option<T>> {
        Ok(None)
    }

    /// After bytes of the recognised board, or a while without any, also while it is lost: may queue requests.
    fn idle(&mut self, _client: &mut Client) -> Result<()> {
        Ok(())
    }

    /// Of the end of the stream.
    fn ended(&mut self, _client: &Client, _stamp: Stamp) -> Result<Option<T>> {
        Ok(None)
    }
}

impl<T, F: FnMut(&Client, &Event, Stamp) -> Option<T> + Send> Teller<T> for F {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<T>> {
        Ok(self(client, event, stamp))
    }
}
