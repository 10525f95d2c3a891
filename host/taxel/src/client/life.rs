//! State that a client keeps of its board between restarts.

use super::again::Again;
use super::wanted::Wanted;
use crate::time::Instant;
use taxel_core::format::Micros;

/// Tolerated error of a board's clock, besides a hundredth of the elapsed time, us.
const SLACK_US: u64 = 250_000;
/// State of a board between restarts.
#[derive(Debug, Default, Clone)]
pub(super) struct Life {
    /// Settings that were requested.
    pub wanted: Wanted,
    /// The restore in progress.
    pub again: Again,
    /// The board has answered `Start` since its last restart.
    pub started: bool,
    /// A `Hello` has come since the link was opened.
    pub met: bool,
    /// The link was reopened, and it is not known yet which board answers and whether it has restarted.
    pub reopened: bool,
    /// Numbers of messages have stepped back since.
    pub stepped_back: bool,
    /// The board has said which it is since the link was opened, and since its last restart.
    pub is_known: bool,
    /// Difference of the board that answers from the one that is waited for.
    pub refused: Option<String>,
    /// Difference that was reported.
    pub reported_other: Option<String>,
    /// The board has probably kept running when the link was last lost.
    pub lived_on: bool,
    /// Number of `Hello`s since any other message.
    pub hellos: u8,
    /// Last known board time, and when it was received.
    pub clock: Option<(Micros, Instant)>,
}

impl Life {
    /// True if a clock that shows this time has run on since it was last received.
    pub fn goes_on(&self, clock: Micros) -> bool {
        self.clock.is_some_and(|(then, since)| {
            let passed = u64::try_from(since.elapsed().as_micros()).unwrap_or(u64::MAX);
            let expected = then.0.saturating_add(passed);
            clock >= then && clock.0.abs_diff(expected) <= SLACK_US.saturating_add(passed / 100)
        })
    }
}
