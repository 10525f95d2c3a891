//! Events of a robot: what its boards say, and how they are.

use crate::client::Stamp;
use crate::error::Error;
use std::time::Duration;

/// An event of one of a robot's boards.
#[derive(Debug)]
pub struct RobotEvent<T> {
    /// Number of the board.
    pub board: usize,
    /// Time of the event: the host's, which all boards share, its uncertainty, and the board's own.
    pub stamp: Stamp,
    /// Content of the event.
    pub what: BoardEvent<T>,
}

/// News or state of a board.
#[derive(Debug)]
pub enum BoardEvent<T> {
    /// Result that an observer has [made](super::BoardQueue::add) of the board's stream.
    News(T),
    /// State of the board from now on.
    State(BoardState),
}

/// State of a board.
#[derive(Debug)]
pub enum BoardState {
    /// Board that is not there at the start, and is waited for.
    Absent {
        /// Reason why it cannot be opened.
        why: String,
    },
    /// Board that is recognised for the first time.
    Met,
    /// Board that is lost, and is waited for; the other boards go on.
    Lost {
        /// Host time at which it was last heard, us since 1970.
        since_us: u64,
        /// Reason why it is lost.
        why: String,
    },
    /// Board that is back and recognised, and whose settings are restored.
    Back {
        /// Time for which it was gone.
        after: Duration,
    },
    /// Another board answers in its place. Nothing that it sends is passed on.
    Other {
        /// Sentence on how it differs.
        why: String,
    },
    /// Images were dropped, because whoever takes the events did not keep up.
    Dropped {
        /// Number of images of this board dropped so far.
        images: u64,
    },
    /// End of its simulation or recording, or of the time for which it was to be followed.
    Over {
        /// Remark on what was left out, of a recording that is damaged.
        remark: Option<String>,
    },
    /// Board that cannot be followed any longer, for example because it refuses what it had accepted before.
    Failed(Error),
}
