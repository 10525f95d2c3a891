//! Line counters of a file, stored in it so that `taxel info` need not read all of it.

use crate::client::Counts;
use std::collections::BTreeMap;

/// Name of the metadata.
pub const COUNTS: &str = "counts";

/// Counts of a file.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    /// Frames received.
    pub frames: u64,
    /// Messages lost on the line.
    pub lost: u64,
    /// Frames that the board thinned out.
    pub thinned: u64,
    /// Images and raw codes that could not be decoded.
    pub undecoded: u64,
    /// Frames of the wire that are not messages.
    pub refused: u64,
    /// Restarts of the board.
    pub restarts: u64,
}

impl Tally {
    /// Counters of a connection so far.
    pub fn of(counts: &Counts) -> Tally {
        Tally {
            frames: counts.frames,
            lost: counts.lost,
            thinned: counts.thinned,
            undecoded: counts.undecoded,
            refused: counts.refused(),
            restarts: counts.restarts,
        }
    }

    fn fields(self) -> [(&'static str, u64); 6] {
        let Tally { frames, lost, thinned, undecoded, refused, restarts } = self;
        [
            ("frames", frames),
            ("lost", lost),
            ("thinned", thinned),
            ("undecoded", undecoded),
            ("refused", refused),
            ("restarts", restarts),
        ]
    }

    /// Encodes as metadata; `before` is the tally when the file began.
    pub fn words(self, before: Tally) -> BTreeMap<String, String> {
        let both = self.fields().into_iter().zip(before.fields());
        both.map(|((name, now), (_, then))| (name.into(), now.saturating_sub(then).to_string())).collect()
    }

    /// Decodes metadata; none if a number is missing.
    pub fn read(words: &BTreeMap<String, String>) -> Option<Tally> {
        let number = |name: &str| words.get(name)?.parse().ok();
        Some(Tally {
            frames: number("frames")?,
            lost: number("lost")?,
            thinned: number("thinned")?,
            undecoded: number("undecoded")?,
            refused: number("refused")?,
            restarts: number("restarts")?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_counted_before_a_file_is_not_of_it() {
        let before = Tally { frames: 10, lost: 1, ..Tally::default() };
        let now = Tally { frames: 15, lost: 1, thinned: 2, undecoded: 3, refused: 4, restarts: 5 };
        let words = now.words(before);
        assert_eq!(Tally::read(&words), Some(Tally { frames: 5, lost: 0, ..now }));
        assert_eq!(Tally::read(&BTreeMap::from([("frames".into(), "5".into())])), None);
    }
}
