//! Reactions that began or ended, until they are sent.

use crate::react::Reaction;
use crate::wire::ReactionReport;
use heapless::Deque;

/// Greatest number of reports that wait.
const MOST: usize = 16;

/// Reports of reactions, the oldest first.
pub(super) struct ReactionQueue(Deque<ReactionReport, MOST>);

impl ReactionQueue {
    pub const fn new() -> ReactionQueue {
        ReactionQueue(Deque::new())
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds a report. Returns false if there was no room without dropping one.
    pub fn push(&mut self, report: ReactionReport) -> bool {
        let is_whole = !self.0.is_full() || !self.forget(&report.reaction);
        self.0.push_back(report).is_ok() && is_whole
    }

    /// Takes the oldest report.
    pub fn pop(&mut self) -> Option<ReactionReport> {
        self.0.pop_front()
    }

    /// Drops the oldest report of a reaction for which a later one, or `next`, is queued, so that the present
    /// state of each is always sent. Returns true if there was one.
    #[cold]
    fn forget(&mut self, next: &Reaction) -> bool {
        let name = |at: usize| self.0.iter().nth(at).map_or(&next.name, |report| &report.reaction.name);
        let count = self.0.len();
        let Some(old) = (0..count).find(|old| (old + 1..=count).any(|at| name(at) == name(*old))) else {
            return false;
        };
        for at in 0..count {
            let report = self.0.pop_front().filter(|_| at != old);
            report.into_iter().for_each(|report| _ = self.0.push_back(report));
        }
        true
    }
}
