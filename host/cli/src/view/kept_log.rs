//! Lines of the log that are kept for pages that come later.

use super::lines::LogLine;
use super::said::Said;
use std::collections::VecDeque;

/// Lines kept whatever their age.
const LEAST: usize = 512;
/// Most lines kept.
const MOST: usize = 4096;
/// Age up to which more than the least are kept, us: that of a page's images.
const KEPT: u64 = 30_000_000;

/// The newest lines: all of the half minute before, if they are not too many.
#[derive(Debug, Default)]
pub struct KeptLog(VecDeque<Said>);

impl KeptLog {
    /// Adds a line.
    pub fn push(&mut self, said: Said) {
        let now = said.time_us;
        self.0.push_back(said);
        let is_old = |oldest: &Said| match (now, oldest.time_us) {
            (None, _) => false,
            (_, None) => true,
            (Some(now), Some(then)) => now.abs_diff(then) > KEPT,
        };
        while self.0.len() > MOST || (self.0.len() > LEAST && self.0.front().is_some_and(is_old)) {
            self.0.pop_front();
        }
    }

    /// The message `log`; none without a line.
    pub fn message(&self) -> Option<LogLine<'_>> {
        (!self.0.is_empty()).then(|| LogLine { said: self.0.iter().map(Said::message).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lines_of_the_half_minute_are_kept_if_they_are_not_too_many() {
        let kept = |lines: u64, us: u64| {
            let mut log = KeptLog::default();
            let said = |n| Said { time_us: Some(n * us), ..Said::note("a line") };
            (0..lines).for_each(|n| log.push(said(n)));
            log.push(Said::note("a line without a time"));
            log.message().unwrap().said.len()
        };
        // 100 lines a second for 25 s, and for a minute; one a second; and more than anybody reads.
        let counts = [kept(2_500, 10_000), kept(6_000, 10_000), kept(600, 1_000_000), kept(9_000, 1_000)];
        assert_eq!(counts, [2_501, 3_002, LEAST + 1, MOST]);
        assert!(KeptLog::default().message().is_none());
    }
}
