//! Progress of long tasks, on standard error from the third second on, if it is a terminal.

use crate::time::Instant;
use std::fmt;
use std::io::{IsTerminal, Write, stderr};
use std::time::Duration;

/// Shorter tasks show no progress.
const QUIET: Duration = Duration::from_secs(2);
/// Time between two updates on a terminal, or between two lines with `-v` without one.
const LOOK: Duration = Duration::from_millis(200);
const LINE: Duration = Duration::from_secs(10);

/// Unit of the progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Bytes, shown in megabytes.
    Bytes,
    /// Frames.
    Frames,
    /// Microseconds of a board, shown in seconds.
    BoardTime,
    /// Steps with this name.
    Steps(&'static str),
}

impl Unit {
    /// Formats a count with its unit.
    fn text_of(self, count: f64) -> String {
        match self {
            Unit::Bytes => format!("{:.1} MB", count / 1e6),
            Unit::Frames => format!("{count:.0} frames"),
            Unit::BoardTime => format!("{:.1} s", count / 1e6),
            Unit::Steps(name) => format!("{count:.0} {name}"),
        }
    }

    /// Formats a rate.
    fn rate(self, rate: f64) -> String {
        match self {
            Unit::BoardTime => format!("{:.1} x real time", rate / 1e6),
            Unit::Steps(_) if rate < 10.0 => format!("{rate:.1}/s"),
            _ => format!("{}/s", self.text_of(rate)),
        }
    }
}

/// Progress of a task. Dropping it clears the line on the terminal.
#[derive(Debug)]
pub struct Progress {
    what: String,
    unit: Unit,
    total: Option<u64>,
    began: Instant,
    /// Time since the start at which the next update is due; none if it is not shown.
    due: Option<Duration>,
    terminal: bool,
    shown: bool,
}

impl Progress {
    /// Starts now; `total` is the final count, if known.
    pub fn of(what: impl fmt::Display, unit: Unit, total: Option<u64>) -> Progress {
        let terminal = stderr().is_terminal();
        let due = if terminal { Some(QUIET) } else { log::log_enabled!(log::Level::Info).then_some(LINE) };
        let total = total.filter(|total| *total > 0);
        Progress { what: what.to_string(), unit, total, began: Instant::now(), due, terminal, shown: false }
    }

    /// Updates the count.
    pub fn at(&mut self, done: u64) {
        if self.due.is_some() {
            self.say(|progress, passed| progress.line(&progress.unit.text_of(done as f64), done, passed));
        }
    }

    /// Updates the count, and shows this text with it.
    pub fn show(&mut self, done: u64, text: impl FnOnce() -> String) {
        self.say(|progress, passed| progress.line(&text(), done, passed));
    }

    /// Sets the final count once it is known.
    pub fn expect(&mut self, total: u64) {
        self.total = Some(total).filter(|total| *total > 0);
    }

    /// Clears the line before other output.
    pub fn clear(&mut self) {
        if self.terminal && std::mem::take(&mut self.shown) {
            let _ = write!(stderr(), "\r\x1b[K");
        }
    }

    fn say(&mut self, line: impl FnOnce(&Progress, Duration) -> String) {
        let passed = self.began.elapsed();
        if self.due.is_none_or(|due| passed < due) {
            return;
        }
        let line = line(self, passed);
        // Errors are ignored: standard error may be closed.
        let _ = if self.terminal { write!(stderr(), "\r{line}\x1b[K") } else { writeln!(stderr(), "{line}") };
        self.due = Some(passed + if self.terminal { LOOK } else { LINE });
        self.shown = true;
    }

    /// Formats share, speed and remaining time.
    fn line(&self, so_far: &str, done: u64, passed: Duration) -> String {
        let rate = done as f64 / passed.as_secs_f64().max(1e-9);
        let Some(total) = self.total else {
            return format!("{}: {so_far}, {}", self.what, self.unit.rate(rate));
        };
        let part = 100.0 * (done as f64 / total as f64).min(1.0);
        let left = if rate > 0.0 { time(total.saturating_sub(done) as f64 / rate) } else { "?".into() };
        format!("{}: {part:.0} %, {so_far}, {}, {left} left", self.what, self.unit.rate(rate))
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}

/// Formats a time: `42 s`, `3 min 5 s`, `2 h 10 min`.
fn time(seconds: f64) -> String {
    match seconds.ceil().min(1e9) as u64 {
        s @ 0..60 => format!("{s} s"),
        s @ 60..3600 => format!("{} min {} s", s / 60, s % 60),
        s => format!("{} h {} min", s / 3600, s / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress(unit: Unit, total: Option<u64>) -> Progress {
        let mut progress = Progress::of("reading a.mcap", unit, total);
        progress.due = None;
        progress
    }

    /// Formats the line of a progress.
    fn line(progress: &Progress, done: u64) -> String {
        progress.line(&progress.unit.text_of(done as f64), done, Duration::from_secs(4))
    }

    #[test]
    fn rate_and_remaining_time_are_reported() {
        let bytes = progress(Unit::Bytes, Some(45_000_000));
        assert_eq!(line(&bytes, 9_000_000), "reading a.mcap: 20 %, 9.0 MB, 2.2 MB/s, 16 s left");
        assert_eq!(line(&bytes, 0), "reading a.mcap: 0 %, 0.0 MB, 0.0 MB/s, ? left");
        assert_eq!(line(&bytes, 50_000_000), "reading a.mcap: 100 %, 50.0 MB, 12.5 MB/s, 0 s left");
        let open = progress(Unit::Frames, None);
        assert_eq!(line(&open, 800), "reading a.mcap: 800 frames, 200 frames/s");
        let played = progress(Unit::BoardTime, Some(1_800_000_000));
        assert_eq!(line(&played, 8_000_000), "reading a.mcap: 0 %, 8.0 s, 2.0 x real time, 14 min 56 s left");
        let steps = progress(Unit::Steps("folds"), Some(10));
        assert_eq!(line(&steps, 1), "reading a.mcap: 10 %, 1 folds, 0.2/s, 36 s left");
        assert_eq!(time(7300.0), "2 h 1 min");
    }

    #[test]
    fn nothing_is_said_before_it_is_time_or_where_nobody_sees_it() {
        let mut unseen = progress(Unit::Frames, Some(2));
        unseen.began = Instant::now().checked_sub(Duration::from_secs(60)).unwrap();
        unseen.at(1);
        assert!(!unseen.shown);
        unseen.due = Some(QUIET);
        unseen.show(1, || "one".into());
        assert!(unseen.shown && unseen.due > Some(Duration::from_secs(60)));
        unseen.shown = false;
        unseen.at(2);
        assert!(!unseen.shown, "not twice in a moment");
    }
}
