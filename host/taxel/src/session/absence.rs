//! A lost source, until it is back.

use crate::error::Error;
use crate::source::{Return, Source};
use crate::time::{Instant, sleep};
use std::time::Duration;

/// Time between two attempts: initial and longest.
const TRY: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(1)];
/// Least duration of an attempt, so that a waiting loop does not spin.
const LOOK: Duration = Duration::from_millis(20);

/// Since when the source is lost, and why.
#[derive(Debug)]
pub struct Absence {
    since: Instant,
    why: Error,
    next: Instant,
    pause: Duration,
}

impl Absence {
    /// The stream has a gap since `since`.
    pub fn new(why: Error, since: Instant) -> Absence {
        Absence { since, why, next: Instant::now(), pause: TRY[0] }
    }

    /// Duration so far.
    pub fn lasts(&self) -> Duration {
        self.since.elapsed()
    }

    /// Returns why the source was lost.
    pub fn why(self) -> Error {
        self.why
    }

    /// Tries to open the source if an attempt is due; else waits briefly.
    pub(crate) fn try_open(&mut self, open: &mut Return) -> Option<Source> {
        if Instant::now() < self.next {
            sleep(LOOK);
            return None;
        }
        let opened = open();
        self.next = Instant::now() + self.pause;
        self.pause = (self.pause * 2).min(TRY[1]);
        match opened {
            Ok(source) => Some(source),
            Err(error) => {
                log::info!("not back yet: {error:#}");
                None
            }
        }
    }
}
