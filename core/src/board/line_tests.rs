//! Tests of lines and inputs: at the start, after a change of garment, on request, and on evidence.

use super::refusal::Refusal;
use super::retest::Retest;
use crate::acquire::ScanError;
use crate::format::Micros;
use crate::selftest::Findings;
use crate::wire::SelfTestReport;

/// Findings on lines and inputs, and whether they are to be tested.
pub(super) struct LineTests {
    /// The last test with the present garment.
    report: Option<SelfTestReport>,
    retest: Retest,
    /// True if the circuit has changed since the last test.
    is_rewired: bool,
}

/// Result of a test.
pub(super) enum Tested {
    /// Test made on evidence; true: its findings are new.
    OnEvidence(bool),
    /// Test made for any other reason; the refusal if it failed.
    Else(Option<Refusal>),
}

impl LineTests {
    pub const fn new() -> LineTests {
        LineTests { report: None, retest: Retest::new(), is_rewired: false }
    }

    /// The last test with the present garment.
    pub fn report(&self) -> Option<&SelfTestReport> {
        self.report.as_ref()
    }

    /// Number of faults known.
    pub fn faults(&self) -> usize {
        self.report.as_ref().map_or(0, |report| report.findings.faults.len())
    }

    /// The garment has changed: nothing is known of its circuit.
    pub fn rewired(&mut self) {
        *self = LineTests { is_rewired: true, ..LineTests::new() };
    }

    /// Records evidence against a line or an input.
    pub fn raise(&mut self, now: Micros) {
        self.retest.raise(now);
    }

    /// True if a test is to be made now.
    pub fn begin(&mut self) -> bool {
        core::mem::take(&mut self.is_rewired) || self.retest.follow()
    }

    /// Takes the result of a test.
    #[inline(never)]
    pub fn tested(&mut self, now: Micros, result: Result<Findings, ScanError>) -> Tested {
        self.is_rewired = false;
        let (is_new, refusal) = match result {
            Ok(findings) => (self.found(now, findings), None),
            Err(error) => (false, Some(Refusal::of(error))),
        };
        if self.retest.settle(now, is_new, self.faults() > 0) {
            return Tested::OnEvidence(is_new);
        }
        Tested::Else(refusal)
    }

    /// Stores the findings. Returns true if the faults differ from those known before.
    fn found(&mut self, time: Micros, findings: Findings) -> bool {
        let known = self.report.as_ref().map_or(&[][..], |report| report.findings.faults.as_slice());
        let is_new = known != findings.faults.as_slice();
        self.report = Some(SelfTestReport { time, findings });
        is_new
    }
}
