//! A source that is gone, until it is back.

use crate::source::{Return, Source};
use crate::verbose;
use anyhow::Error;
use std::thread;
use std::time::{Duration, Instant};

/// Time between two tries: at first, and at most.
const TRY: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(1)];
/// How long one look takes at least, so that who waits does not spin.
const LOOK: Duration = Duration::from_millis(20);

/// Since when it is gone, and why.
#[derive(Debug)]
pub struct Absence {
    since: Instant,
    why: Error,
    next: Instant,
    pause: Duration,
}

impl Absence {
    /// Of a stream that has a gap since then.
    pub fn new(why: Error, since: Instant) -> Absence {
        Absence { since, why, next: Instant::now(), pause: TRY[0] }
    }

    /// How long it lasts.
    pub fn lasts(&self) -> Duration {
        self.since.elapsed()
    }

    /// Why it is gone.
    pub fn why(self) -> Error {
        self.why
    }

    /// Tries to open the source, if it is time; waits a little otherwise.
    pub fn try_open(&mut self, open: &mut Return) -> Option<Source> {
        if Instant::now() < self.next {
            thread::sleep(LOOK);
            return None;
        }
        let opened = open();
        self.next = Instant::now() + self.pause;
        self.pause = (self.pause * 2).min(TRY[1]);
        match opened {
            Ok(source) => Some(source),
            Err(error) => {
                verbose::tell(format_args!("not back yet: {error:#}"));
                None
            }
        }
    }
}
