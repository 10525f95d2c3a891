//! Results of the checks.

use crate::counts::Counts;

/// Result of a check.
#[derive(Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Passed, with its number of tests.
    Passed(Counts),
    /// Failed, with its number of tests, and why.
    Failed(Counts, String),
    /// It could not run, and why.
    NotRun(String),
}

/// Results of all checks.
#[derive(Debug, Default)]
pub struct Report {
    counts: Counts,
    failed: Vec<&'static str>,
    missing: Vec<(&'static str, String)>,
}

impl Report {
    /// Adds the result of a check.
    pub fn add(&mut self, name: &'static str, outcome: Outcome) {
        match outcome {
            Outcome::Passed(counts) => self.counts += counts,
            Outcome::Failed(mut counts, _) => {
                // A check that fails without a failed test, by a warning or a panic, counts as one failure.
                counts.failed = counts.failed.max(1);
                self.counts += counts;
                self.failed.push(name);
            }
            Outcome::NotRun(why) => self.missing.push((name, why)),
        }
    }

    /// True if everything passed, and nothing is missing except for `may_miss`.
    pub fn succeeded(&self, may_miss: &[String]) -> bool {
        self.failed.is_empty() && self.missing.iter().all(|(name, _)| may_miss.iter().any(|may| may == name))
    }

    /// Summary of the results.
    pub fn closing(&self) -> String {
        let Counts { passed, failed, skipped } = self.counts;
        let why =
            self.missing.iter().map(|(name, why)| format!("{name}: {why}")).collect::<Vec<_>>().join("; ");
        let why = if why.is_empty() { String::new() } else { format!(" ({why})") };
        let names =
            if self.failed.is_empty() { String::new() } else { format!(" ({})", self.failed.join(", ")) };
        let missing = self.missing.len();
        let skipped = skipped + missing as u32;
        format!(
            "passed {passed}, failed {failed}{names}, not run {missing}{why}\n\
             {passed} passed, {failed} failed, {skipped} skipped"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_fails_unless_it_may_be() {
        let mut report = Report::default();
        report.add("test", Outcome::Passed(Counts { passed: 5, failed: 0, skipped: 1 }));
        report.add("recorded", Outcome::NotRun("no data".into()));
        assert!(!report.succeeded(&[]));
        assert!(report.succeeded(&["recorded".into()]));
        assert_eq!(
            report.closing(),
            "passed 5, failed 0, not run 1 (recorded: no data)\n5 passed, 0 failed, 2 skipped"
        );
        report.add("fmt", Outcome::Failed(Counts::default(), "exit status: 1".into()));
        assert!(!report.succeeded(&["recorded".into()]));
        assert!(report.closing().ends_with("5 passed, 1 failed, 2 skipped"));
    }
}
