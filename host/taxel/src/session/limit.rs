//! The end of a run that is limited in time.

use super::Session;
use crate::client::passed::Passed;
use crate::client::{Event, ImageNews};
use crate::error::SourceError;
use std::time::{Duration, Instant};
use taxel_core::wire::Level;

/// Longest wait for what a board owes a run of limited time: its first `Hello`, its return, an image.
pub const PATIENCE: Duration = Duration::from_secs(10);
/// Most that counts as waiting between two looks: whoever looks more rarely was busy or asleep, not waiting.
const LOOK: Duration = Duration::from_secs(1);

/// The limit of a run, by the board's time as its images tell it.
///
/// A board that sends none, because its scene asks for none or its scan fails, must not make a run endless: without
/// an image for [`PATIENCE`], or for the whole limit if that is longer, the limit is reached, too, and the session
/// notes why.
#[derive(Debug, Clone)]
pub struct TimeLimit {
    longest: Duration,
    passed: Passed,
    /// How long an image has been waited for.
    imageless: Duration,
    looked: Instant,
    is_reached: bool,
}

impl TimeLimit {
    /// Ends a run after so much time.
    pub fn of(longest: Duration) -> TimeLimit {
        TimeLimit {
            longest,
            passed: Passed::default(),
            imageless: Duration::ZERO,
            looked: Instant::now(),
            is_reached: false,
        }
    }

    /// Handles an event. Returns true once the limit is reached.
    pub fn take(&mut self, event: &Event) -> bool {
        if let Event::Frame { time, image: ImageNews::Whole, .. } = event {
            self.imageless = Duration::ZERO;
            self.is_reached |= Duration::from_micros(self.passed.until(time.0)) >= self.longest;
        }
        self.is_reached
    }

    /// Looks at the clock. Returns true once the limit is reached.
    pub fn look(&mut self, session: &mut Session) -> bool {
        let passed = std::mem::replace(&mut self.looked, Instant::now()).elapsed();
        // A recording ends by itself, and a lost board is waited for elsewhere.
        self.imageless = match session.source().listens && !session.is_gone() {
            true => self.imageless + passed.min(LOOK),
            false => Duration::ZERO,
        };
        if !self.is_reached && self.imageless >= self.longest.max(PATIENCE) {
            self.is_reached = true;
            session.say(Level::Info, self.missing(session));
        }
        self.is_reached
    }

    /// Error of a run that waits for images, whatever its limit, once none has come for [`PATIENCE`].
    pub fn check_images(&self, session: &Session) -> Result<(), SourceError> {
        match self.imageless < PATIENCE {
            true => Ok(()),
            false => Err(SourceError::Silent(self.missing(session))),
        }
    }

    fn missing(&self, session: &Session) -> String {
        let (label, seconds) = (&session.source().label, self.imageless.as_secs());
        format!("{label}: no image came for {seconds} s: the scene sends none, or the scan fails")
    }
}
