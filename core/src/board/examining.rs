//! The self-test: results of the test of lines and inputs, and a retest of all taxels.

use super::Board;
use super::refusal::Refusal;
use super::work::Work;
use crate::acquire::ScanError;
use crate::format::Micros;
use crate::selftest::Findings;
use crate::wire::SelfTestReport;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Takes the result of a test of lines and inputs, made at the start, after a change of garment, on
    /// request, or because of evidence against one of them.
    #[inline(never)]
    pub(super) fn examined(&mut self, now: Micros, result: Result<Findings, ScanError>) {
        self.rewired = false;
        let (is_new, refusal) = match result {
            Ok(findings) => (self.found(now, findings), None),
            Err(error) => (false, Some(Refusal::of(error))),
        };
        let is_faulty = self.examined.as_ref().is_some_and(|report| !report.findings.faults.is_empty());
        let retested = self.retest.settle(now, is_new, is_faulty);
        if retested {
            self.interrupted = true;
            if is_new {
                self.outbox.examined();
            }
            return;
        }
        // The tests at the start and after a change of garment were not requested: their result goes out with
        // the other news of it.
        let Some(us) = self.saving.ended(now) else { return };
        self.not_scanned(us);
        if refusal.is_none() {
            self.recover();
            self.outbox.examined();
        }
        self.outbox.answer(Work::SelfTest.request(), refusal);
    }

    /// Stores the findings. Returns true if the faults differ from those known before.
    fn found(&mut self, time: Micros, findings: Findings) -> bool {
        let known = self.examined.as_ref().map_or(&[][..], |report| report.findings.faults.as_slice());
        let is_new = known != findings.faults.as_slice();
        self.examined = Some(SelfTestReport { time, findings });
        is_new
    }
}
