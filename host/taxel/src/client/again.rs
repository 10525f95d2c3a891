//! Restores the settings of a restarted board: one request after the other, each sent once the last is
//! answered.

use super::wanted::WantedSetting;
use crate::time::Instant;
use std::collections::VecDeque;
use std::time::Duration;
use taxel_core::wire::Request;

/// Time after which an unanswered request is repeated; that of a tare is longer, because the board answers
/// when it is done.
const PATIENCE: Duration = Duration::from_secs(2);
const TARE_PATIENCE: Duration = Duration::from_secs(90);
/// Attempts for each request.
const TRIES: u8 = 3;
/// Request number of `Tare`.
const TARE: u8 = Request::Tare { frames: 0 }.number();
/// Request number in the answer to an unreadable request.
const UNREADABLE: u8 = 255;

/// Result of a restore.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Restored {
    /// All requests were answered.
    Done {
        /// Numbers of the requests, in order.
        set: Vec<u8>,
        /// Reason why there is no new tare. The board refuses a tare only if it has had a baseline since its start.
        untared: Option<String>,
    },
    /// The board refuses the request with this number, and why.
    Refused(u8, String),
    /// The board does not answer the request with this number.
    Silent(u8),
}

/// A restore in progress.
#[derive(Debug, Default, Clone)]
pub(super) struct Again {
    /// Requests still to be sent.
    left: VecDeque<WantedSetting>,
    waits: Option<Waiting>,
    done: Vec<u8>,
    untared: Option<String>,
    ended: Option<Restored>,
}

#[derive(Debug, Clone)]
struct Waiting {
    setting: WantedSetting,
    since: Instant,
    tries: u8,
}

impl Again {
    /// Starts with these requests; drops a restore in progress.
    pub fn begin(&mut self, settings: VecDeque<WantedSetting>) {
        *self = Again { left: settings, ..Again::default() };
        self.end_if_over();
    }

    /// True while requests are to be sent or answers are awaited.
    pub(crate) fn is_under_way(&self) -> bool {
        self.waits.is_some() || !self.left.is_empty()
    }

    /// Returns the frame to send now, if any.
    pub fn due(&mut self) -> Option<Vec<u8>> {
        if let Some(waiting) = &mut self.waits {
            let patience = if waiting.setting.number == TARE { TARE_PATIENCE } else { PATIENCE };
            if waiting.since.elapsed() < patience {
                return None;
            }
            if waiting.tries < TRIES {
                waiting.tries += 1;
                waiting.since = Instant::now();
                return Some(waiting.setting.frame.clone());
            }
            let number = waiting.setting.number;
            self.end(Restored::Silent(number));
            return None;
        }
        let setting = self.left.pop_front()?;
        let frame = setting.frame.clone();
        self.waits = Some(Waiting { setting, since: Instant::now(), tries: 1 });
        Some(frame)
    }

    /// Handles an answer of the board.
    pub fn answered(&mut self, number: u8, refusal: Option<&str>) {
        let Some(waiting) = &mut self.waits else { return };
        if number == UNREADABLE {
            // The line was noisy: repeat at once.
            waiting.since = waiting.since.checked_sub(TARE_PATIENCE).unwrap_or(waiting.since);
            return;
        }
        if number != waiting.setting.number {
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

    /// Returns the result, once.
    pub fn ended(&mut self) -> Option<Restored> {
        self.ended.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting(number: u8) -> WantedSetting {
        WantedSetting { number, frame: vec![number, 0] }
    }

    #[test]
    fn each_is_answered_before_the_next_and_a_refusal_ends_it() {
        let mut again = Again::default();
        again.begin([setting(0), setting(1), setting(3)].into());
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
        again.begin([setting(1), setting(3)].into());
        again.due();
        again.answered(1, Some("too many"));
        assert_eq!(again.ended(), Some(Restored::Refused(1, "too many".into())));
        assert!(!again.is_under_way() && again.due().is_none());
        again.begin(VecDeque::new());
        assert_eq!(again.ended(), done(&[]));
    }

    #[test]
    fn a_tare_that_is_refused_ends_nothing() {
        let mut again = Again::default();
        again.begin([setting(0), setting(TARE), setting(4)].into());
        for (number, refusal) in [(0, None), (TARE, Some("touched")), (4, None)] {
            assert!(again.due().is_some());
            again.answered(number, refusal);
        }
        assert_eq!(again.ended(), Some(Restored::Done { set: vec![0, 4], untared: Some("touched".into()) }));
    }

    #[test]
    fn who_never_answers_is_asked_three_times() {
        let mut again = Again::default();
        again.begin([setting(1)].into());
        for _ in 0..TRIES {
            assert!(again.due().is_some() && again.due().is_none());
            again.answered(UNREADABLE, None);
        }
        assert_eq!((again.due(), again.ended()), (None, Some(Restored::Silent(1))));
    }
}
