//! Summary of a whole recording: total force, intentions, and log lines with their times.

use crate::view::line_kind::LineKind;
use crate::view::lines::OverviewLine;
use crate::view::said::Said;
use taxel_core::intent::Leading;

/// Most bins of the totals, and the least width of one, us.
const PLACES: u64 = 16_384;
const SHORTEST: u64 = 10_000;
/// Most lines kept; beyond that, lines about contacts are only counted.
const LINES: usize = 50_000;
/// Most changes of intention kept.
const CHANGES: usize = 50_000;

/// The summary so far. Times are microseconds since the recording began.
#[derive(Debug, Clone)]
pub struct Overview {
    width: u64,
    /// Greatest total of each bin, counts.
    totals: Vec<u32>,
    /// Time of the current total, and the total, counts.
    total: (u64, u32),
    intentions: Vec<(u64, &'static str)>,
    said: Vec<(u64, Said)>,
    unlisted: u64,
    /// Time up to which everything is known.
    known: u64,
    duration: u64,
}

impl Overview {
    /// An empty summary of a recording with this duration.
    pub fn new(duration: u64) -> Overview {
        let width = duration.div_ceil(PLACES).max(SHORTEST);
        Overview {
            width,
            totals: vec![0; (duration / width + 1) as usize],
            total: (0, 0),
            intentions: Vec::new(),
            said: Vec::new(),
            unlisted: 0,
            known: 0,
            duration,
        }
    }

    /// Sets the total from this time on; the total before lasts until then.
    pub fn press(&mut self, at: u64, total: u32) {
        let (since, before) = std::mem::replace(&mut self.total, (at, total));
        self.raise(since, at, before);
        self.raise(at, at, total);
    }

    fn raise(&mut self, from: u64, to: u64, total: u32) {
        let [first, last] = [from, to].map(|time| (time / self.width) as usize);
        if total > 0 && first <= last {
            let places = self.totals.iter_mut().take(last + 1).skip(first);
            places.for_each(|place| *place = (*place).max(total));
        }
    }

    /// Sets the leading intention from this time on.
    pub fn lead(&mut self, at: u64, leading: Leading) {
        let name = leading.as_str();
        let before = self.intentions.last().map_or("none", |(_, name)| name);
        if before != name && self.intentions.len() < CHANGES {
            self.intentions.push((at, name));
        }
    }

    /// Adds a log line.
    pub fn say(&mut self, at: u64, said: Said) {
        let touches = matches!(said.kind, LineKind::Onset | LineKind::Release);
        if self.said.len() < LINES || (!touches && self.said.len() < 2 * LINES) {
            self.said.push((at, said));
        } else {
            self.unlisted += 1;
        }
    }

    /// Everything up to this time has been added.
    pub fn reach(&mut self, at: u64) {
        self.known = self.known.max(at.min(self.duration));
    }

    /// The message `overview`.
    pub fn message(&self) -> OverviewLine<'_> {
        OverviewLine {
            duration_us: self.duration,
            known_us: self.known,
            width_us: self.width,
            totals: &self.totals,
            intentions: &self.intentions,
            said: self.said.iter().map(|(at, said)| (*at, said.kind, said.text.as_str())).collect(),
            unlisted: self.unlisted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_total_of_each_place_is_kept_and_holds_until_the_next() {
        let mut overview = Overview::new(100_000);
        overview.press(10_000, 500);
        overview.press(10_500, 900);
        overview.press(35_000, 0);
        overview.press(99_999, 7);
        assert_eq!(overview.message().totals, [0, 900, 900, 900, 0, 0, 0, 0, 0, 7, 0]);
    }

    #[test]
    fn nothing_grows_without_an_end() {
        let mut overview = Overview::new(36_000_000_000);
        assert!(overview.totals.len() as u64 <= PLACES + 1);
        for at in 0..3 * LINES as u64 {
            overview.say(at, Said { kind: LineKind::Onset, time_us: None, text: String::new() });
            overview.say(at, Said { kind: LineKind::Reaction, time_us: None, text: String::new() });
            overview.lead(at, if at % 2 == 0 { Leading::Attack } else { Leading::None });
        }
        assert_eq!((overview.said.len(), overview.intentions.len()), (2 * LINES, CHANGES));
        assert_eq!(overview.unlisted, 4 * LINES as u64);
    }
}
