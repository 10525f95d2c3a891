//! Sets a board again that has started anew: one request after the other, each answered before the next is
//! made.

use super::wanted::Wish;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// How long an answer may take before the request is made again, and how long that of a tare, which comes when
/// it is done.
const PATIENCE: Duration = Duration::from_secs(2);
const TARE_PATIENCE: Duration = Duration::from_secs(90);
/// Times that a request is made.
const TRIES: u8 = 3;
/// Number of `Tare`.
const TARE: u8 = 2;
/// Number in the answer to a request that could not be read.
const UNREADABLE: u8 = 255;

/// How it ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Restored {
    /// All has been set.
    Done {
        /// The numbers of the requests, in their order.
        set: Vec<u8>,
        /// Why there is no new tare. The board has a baseline in this life: it refuses none before it has.
        untared: Option<String>,
    },
    /// The board refuses a request of this number, and why.
    Refused(u8, String),
    /// The board does not answer a request of this number.
    Silent(u8),
}

/// What is under way.
#[derive(Debug, Default, Clone)]
pub(super) struct Again {
    /// What is still to be asked for.
    left: VecDeque<Wish>,
    waits: Option<Waiting>,
    done: Vec<u8>,
    untared: Option<String>,
    ended: Option<Restored>,
}

#[derive(Debug, Clone)]
struct Waiting {
    wish: Wish,
    since: Instant,
    tries: u8,
}

impl Again {
    /// Begins with these requests, whatever was under way.
    pub fn begin(&mut self, wishes: VecDeque<Wish>) {
        *self = Again { left: wishes, ..Again::default() };
        self.end_if_over();
    }

    /// Whether something is still to be asked for, or an answer to come.
    pub fn is_under_way(&self) -> bool {
        self.waits.is_some() || !self.left.is_empty()
    }

    /// The frame that is to be sent now, if one is.
    pub fn due(&mut self) -> Option<Vec<u8>> {
        if let Some(waiting) = &mut self.waits {
            let patience = if waiting.wish.number == TARE { TARE_PATIENCE } else { PATIENCE };
            if waiting.since.elapsed() < patience {
                return None;
            }
            if waiting.tries < TRIES {
                waiting.tries += 1;
                waiting.since = Instant::now();
                return Some(waiting.wish.frame.clone());
            }
            let number = waiting.wish.number;
            self.end(Restored::Silent(number));
            return None;
        }
        let wish = self.left.pop_front()?;
        let frame = wish.frame.clone();
        self.waits = Some(Waiting { wish, since: Instant::now(), tries: 1 });
        Some(frame)
    }

    /// Takes an answer of the board.
    pub fn answered(&mut self, number: u8, refusal: Option<&str>) {
        let Some(waiting) = &mut self.waits else { return };
        if number == UNREADABLE {
            // The line was noisy: it is made again at once.
            waiting.since = waiting.since.checked_sub(TARE_PATIENCE).unwrap_or(waiting.since);
            return;
        }
        if number != waiting.wish.number {
            return;
        }
        match refusal {
            Some(why) if number == TARE => self.untared = Some(why.into()),
            Some(why) => return self.end(Restored::Refused(number, why.into())),
            None => self.done.push(number),
        }
        self.waits = None;
        self.end_if_over();
    }

    fn end_if_over(&mut self) {
        if !self.is_under_way() {
            let (set, untared) = (std::mem::take(&mut self.done), self.untared.take());
            self.ended = Some(Restored::Done { set, untared });
        }
    }

    fn end(&mut self, how: Restored) {
        *self = Again { ended: Some(how), ..Again::default() };
    }

    /// How it ended, told once.
    pub fn ended(&mut self) -> Option<Restored> {
        self.ended.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::Request;

    fn wish(number: u8) -> Wish {
        Wish { number, frame: vec![number, 0] }
    }

    #[test]
    fn each_is_answered_before_the_next_and_a_refusal_ends_it() {
        let mut again = Again::default();
        again.begin([wish(0), wish(1), wish(3)].into());
        for number in [0, 1] {
            assert_eq!((again.due(), again.due()), (Some(vec![number, 0]), None));
            again.answered(9, Some("of another request"));
            assert_eq!(again.due(), None);
            again.answered(number, None);
        }
        assert_eq!(again.ended(), None);
        again.due();
        again.answered(UNREADABLE, None);
        assert_eq!(again.due(), Some(vec![3, 0]), "made again at once");
        again.answered(3, None);
        let done = |set: &[u8]| Some(Restored::Done { set: set.into(), untared: None });
        assert_eq!((again.ended(), again.ended()), (done(&[0, 1, 3]), None));
        again.begin([wish(1), wish(3)].into());
        again.due();
        again.answered(1, Some("too many"));
        assert_eq!(again.ended(), Some(Restored::Refused(1, "too many".into())));
        assert!(!again.is_under_way() && again.due().is_none());
        again.begin(VecDeque::new());
        assert_eq!(again.ended(), done(&[]));
    }

    #[test]
    fn a_tare_that_is_refused_ends_nothing() {
        assert_eq!(Request::Tare { frames: 1 }.number(), TARE);
        let mut again = Again::default();
        again.begin([wish(0), wish(TARE), wish(12)].into());
        for (number, refusal) in [(0, None), (TARE, Some("touched")), (12, None)] {
            assert!(again.due().is_some());
            again.answered(number, refusal);
        }
        assert_eq!(again.ended(), Some(Restored::Done { set: vec![0, 12], untared: Some("touched".into()) }));
    }

    #[test]
    fn who_never_answers_is_asked_three_times() {
        let mut again = Again::default();
        again.begin([wish(1)].into());
        for _ in 0..TRIES {
            assert!(again.due().is_some() && again.due().is_none());
            again.answered(UNREADABLE, None);
        }
        assert_eq!((again.due(), again.ended()), (None, Some(Restored::Silent(1))));
    }
}
