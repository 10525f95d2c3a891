//! The self-test: of lines and inputs by whoever has them, of the taxels by judging them anew.

use super::refusal::Refusal;
use super::{Board, Work, request};
use crate::acquire::ScanError;
use crate::format::Micros;
use crate::selftest::Findings;
use crate::wire::SelfTestReport;

impl<const TAXELS: usize, const RUNS: usize> Board<TAXELS, RUNS> {
    /// Lines and inputs were examined: at the start, because the garment was changed, or because it was asked for.
    #[inline(never)]
    pub(super) fn examined(&mut self, now: Micros, result: Result<Findings, ScanError>) {
        self.rewired = false;
        let refusal = result
            .map(|findings| self.examined = Some(SelfTestReport { time: now, findings }))
            .err()
            .map(Refusal::of);
        // Nobody asked for the one at the start, nor for that of a changed garment: it is told with what else is new.
        let Some(us) = self.saving.ended(now) else { return };
        self.not_scanned(us);
        if refusal.is_none() {
            self.recover();
            self.outbox.examined();
        }
        self.outbox.answer(request::number_of(Work::SelfTest), refusal);
    }
}
