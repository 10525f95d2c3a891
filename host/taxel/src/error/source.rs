//! Errors of sources and sessions.

use std::time::Duration;
use taxel_core::wire::WireError;

/// Reason why there is no stream, or no more of it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// No board is there: nothing is plugged in, the port is missing, nobody listens.
    #[error("{0}")]
    NoBoard(String),
    /// Another program has the port open.
    #[error("{0}")]
    Busy(String),
    /// The system does not let this user open the port.
    #[error("{0}")]
    NotPermitted(String),
    /// Several boards are plugged in, and none was named.
    #[error("{0}")]
    SeveralBoards(String),
    /// The board is connected, and sends, reads or answers nothing.
    #[error("{0}")]
    Silent(String),
    /// Sender of something else than this program understands: it is no board, or one of another version.
    #[error("{0}")]
    Foreign(String),
    /// The board is gone, and is not waited for any longer. The [cause](super::Error::cause) says why it was
    /// lost.
    #[error("{label} is gone{}", waited(*patience))]
    Gone {
        /// Label of the source.
        label: String,
        /// Time for which it was waited for; none if it was not.
        patience: Option<Duration>,
    },
    /// Another board answers in place of the one that was followed.
    #[error("{0}")]
    Other(String),
    /// The board refuses a request.
    #[error("{what}: {reason}")]
    Refused {
        /// Name of the request, such as `set-garment`.
        request: &'static str,
        /// Words for what is refused, and when.
        what: String,
        /// The board's reason, as it has sent it.
        reason: String,
    },
    /// A request is too long for the wire.
    #[error(transparent)]
    Request(#[from] WireError),
    /// A simulation cannot be started.
    #[error("{0}")]
    Unstarted(String),
}

impl SourceError {
    /// True if the board, or the link to it, is at fault.
    pub fn blames_board(&self) -> bool {
        !matches!(self, SourceError::Request(_) | SourceError::Unstarted(_))
    }
}

fn waited(patience: Option<Duration>) -> String {
    patience
        .map_or(String::new(), |patience| format!(", and has not come back within {} s", patience.as_secs()))
}
