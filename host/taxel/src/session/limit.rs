//! The end of a run that is limited in images or time.

use super::Session;
use crate::client::passed::Passed;
use crate::client::{Event, ImageNews};
use crate::error::SourceError;
use crate::time::Instant;
use std::time::Duration;
use taxel_core::wire::Level;

/// Longest wait for what a board owes a run of limited time: its first `Hello`, its return, an image.
pub const PATIENCE: Duration = Duration::from_secs(10);
/// Most that counts as waiting between two looks: whoever looks more rarely was busy or asleep, not waiting.
const LOOK: Duration = Duration::from_secs(1);

/// Limit at which a run ends: after so many images, or so much of the board's time as its images report it.
///
/// A board that sends none, because its scene asks for none or its scan fails, must not make a run endless: without
/// an image for [`PATIENCE`], or for the whole time if that is longer, the limit is reached, too, and the session
/// notes why. A run that waits for a number of images fails then.
#[derive(Debug, Clone)]
pub struct RunLimit {
    /// Whole images that are still awaited; none: any number.
    frames: Option<u64>,
    /// The raw codes of the last image, which follow it, are awaited, too.
    codes: bool,
    longest: Option<Duration>,
    passed: Passed,
    /// Time for which an image has been waited for.
    imageless: Duration,
    looked: Instant,
    is_reached: bool,
}

impl RunLimit {
    /// Ends a run after so many images, or so much time, whatever comes first; without both it goes on.
    pub fn of(frames: Option<u64>, longest: Option<Duration>) -> RunLimit {
        RunLimit {
            frames,
            codes: false,
            longest,
            passed: Passed::default(),
            imageless: Duration::ZERO,
            looked: Instant::now(),
            is_reached: false,
        }
    }

    /// Returns the limit with the raw codes of the last image awaited, too.
    pub fn with_codes(self) -> RunLimit {
        RunLimit { codes: true, ..self }
    }

    /// True if the run ends at all.
    pub fn is_any(&self) -> bool {
        self.frames.is_some() || self.longest.is_some()
    }

    /// Handles an event. Returns true once the limit is reached.
    pub fn take(&mut self, event: &Event) -> bool {
        if self.frames == Some(0) {
            // None was wanted, or the codes of the last one are.
            self.is_reached |= matches!(event, Event::Raw { .. } | Event::Frame { .. });
        }
        if let Event::Frame { time, image: ImageNews::Whole, .. } = event {
            self.imageless = Duration::ZERO;
            if let Some(frames) = &mut self.frames {
                *frames = frames.saturating_sub(1);
                self.is_reached |= *frames == 0 && !self.codes;
            }
            let passed = Duration::from_micros(self.passed.until(time.0));
            self.is_reached |= self.longest.is_some_and(|longest| passed >= longest);
        }
        self.is_reached
    }

    /// Looks at the clock. Returns true once the limit is reached. Error of a run that waits for images, once none has
    /// come for [`PATIENCE`].
    pub fn look(&mut self, session: &mut Session) -> Result<bool, SourceError> {
        let passed = std::mem::replace(&mut self.looked, Instant::now()).elapsed();
        // A recording ends by itself, and a lost board is waited for elsewhere.
        self.imageless = match session.source().listens && !session.is_gone() {
            true => self.imageless + passed.min(LOOK),
            false => Duration::ZERO,
        };
        let is_late = |longest: Duration| self.imageless >= longest.max(PATIENCE);
        if !self.is_reached && self.longest.is_some_and(is_late) {
            self.is_reached = true;
            session.say(Level::Info, self.missing(session));
        }
        match self.frames {
            Some(_) if !self.is_reached && self.imageless >= PATIENCE => {
                Err(SourceError::Silent(self.missing(session)))
            }
            _ => Ok(self.is_reached),
        }
    }

    fn missing(&self, session: &Session) -> String {
        let (label, seconds) = (&session.source().label, self.imageless.as_secs());
        format!("{label}: no image came for {seconds} s: the scene sends none, or the scan fails")
    }
}
