//! Events of a robot: what its boards say, and how they are.

use crate::client::Stamp;
use crate::error::Error;
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
    /// What an observer has [made](super::BoardQueue::add) of the board's stream.
    News(T),
    /// How the board is from now on.
    State(BoardState),
}

/// How a board is.
#[derive(Debug)]
pub enum BoardState {
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
    /// Its simulation or recording is over, or the time for which it was to be followed.
    Over {
        /// What was left out, of a recording that is damaged.
        remark: Option<String>,
    },
    /// It cannot be followed any longer, for example because it refuses what it had accepted before.
    Failed(Error),
}
