//! The self-test: of lines and inputs by whoever has them, of the taxels by judging them anew.

use super::refusal::Refusal;
use super::{Board, Work, request};
use crate::acquire::ScanError;
use crate::format::Micros;
use crate::selftest::Findings;
use crate::wire::SelfTestReport;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Lines and inputs were examined: at the start, because the garment was changed, because it was asked
    /// for, or because something spoke against one of them.
    #[inline(never)]
    pub(super) fn examined(&mut self, now: Micros, result: Result<Findings, ScanError>) {
        self.rewired = false;
        let (is_new, refusal) = match result {
            Ok(findings) => (self.found(now, findings), None),
            Err(error) => (false, Some(Refusal::of(error))),
        };
        let is_ill = self.examined.as_ref().is_some_and(|report| !report.findings.faults.is_empty());
        let doubted = self.doubt.settle(now, is_new, is_ill);
        if doubted {
            self.interrupted = true;
            if is_new {
                self.outbox.examined();
            }
            return;
        }
        // Nobody asked for the one at the start, nor for that of a changed garment: it is told with what else
        // is new.
        let Some(us) = self.saving.ended(now) else { return };
        self.not_scanned(us);
        if refusal.is_none() {
            self.recover();
            self.outbox.examined();
        }
        self.outbox.answer(request::number_of(Work::SelfTest), refusal);
    }

    /// Keeps what was found; whether the faults are others than those known before.
    fn found(&mut self, time: Micros, findings: Findings) -> bool {
        let known = self.examined.as_ref().map_or(&[][..], |report| report.findings.faults.as_slice());
        let is_new = known != findings.faults.as_slice();
        self.examined = Some(SelfTestReport { time, findings });
        is_new
    }
}
