//! Effects of an input: reports and answers to send, pins to drive, counters.

use super::outbox::Outbox;
use super::outputs::Outputs;
use super::refusal::Refusal;
use crate::format::Micros;
use crate::react::Reaction;
use crate::wire::{Health, ReactionReport};

/// The effects of the inputs so far that have not been carried out. The owners of the board's parts know
/// nothing of each other, but all of them add to these.
pub(super) struct Effects<'a, const TAXELS: usize> {
    pub outbox: &'a mut Outbox<TAXELS>,
    pub outputs: &'a mut Outputs,
    pub health: &'a mut Health,
    /// Number of the last perceived frame.
    pub frame: u32,
}

impl<const TAXELS: usize> Effects<'_, TAXELS> {
    /// Answers a request.
    pub fn answer(&mut self, request: u8, refusal: Option<Refusal>) {
        self.outbox.answer(request, refusal);
    }

    /// Reports a reaction that began or ended.
    pub fn reaction(&mut self, time: Micros, reaction: Reaction) {
        let report = ReactionReport { frame: self.frame, time, reaction };
        self.outbox.reaction(report, self.health);
    }
}
