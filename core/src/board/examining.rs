//! The self-test: of lines and inputs by whoever has them, of the taxels by judging them anew.

use super::outbox::Refusal;
use super::{Board, Work, request};
use crate::acquire::ScanError;
use crate::format::Micros;
use crate::selftest::Findings;
use crate::wire::SelfTestReport;

/// A self-test that was asked for, and what the last one found.
#[derive(Debug, Clone)]
pub(super) struct Examining {
    /// When the one that was asked for began.
    began: Option<Micros>,
    /// Of the garment that is worn.
    pub report: Option<SelfTestReport>,
}

impl Examining {
    pub const fn new() -> Examining {
        Examining { began: None, report: None }
    }

    /// What was asked for begins.
    pub fn begin(&mut self, now: Micros) {
        self.began = Some(now);
    }
}

impl<const TAXELS: usize, const RUNS: usize> Board<TAXELS, RUNS> {
    /// Lines and inputs were examined, at the start or because it was asked for.
    #[inline(never)]
    pub(super) fn examined(&mut self, now: Micros, result: Result<Findings, ScanError>) {
        let asked = self.examining.began.take();
        let refusal = result
            .map(|findings| self.examining.report = Some(SelfTestReport { time: now, findings }))
            .err()
            .map(Refusal::of);
        let Some(began) = asked else { return };
        self.not_scanned(now.since(began));
        if refusal.is_none() {
            self.recover();
            self.outbox.examined();
        }
        self.outbox.answer(request::number_of(Work::SelfTest), refusal);
    }
}
