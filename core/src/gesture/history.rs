//! Signals of the last frames.

use super::course::LAGS;
use super::signal::{SIGNALS, Signals};

/// Number of frames that are kept: the longest lag.
const KEPT: usize = 32;

/// A ring of the last frames' signals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct History {
    ring: [Signals; KEPT],
    /// Index at which the next is written.
    next: usize,
}

impl Default for History {
    fn default() -> Self {
        History::new()
    }
}

impl History {
    /// Ring of zeros.
    pub const fn new() -> History {
        History { ring: [[0; SIGNALS]; KEPT], next: 0 }
    }

    /// Adds the signals of a frame.
    pub fn push(&mut self, signals: &Signals) {
        if let Some(place) = self.ring.get_mut(self.next) {
            *place = *signals;
        }
        self.next = (self.next + 1) % KEPT;
    }

    /// Values of signal `index` as many frames before the next as [`LAGS`] gives.
    pub fn back(&self, index: usize) -> impl Iterator<Item = u16> {
        LAGS.into_iter().map(move |lag| {
            let place = (self.next + KEPT - usize::from(lag)) % KEPT;
            self.ring.get(place).and_then(|signals| signals.get(index)).copied().unwrap_or(0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_looks_back_as_far_as_the_lags() {
        let mut history = History::default();
        (0..100).for_each(|frame| history.push(&[frame; SIGNALS]));
        for (value, lag) in history.back(3).zip(LAGS) {
            assert_eq!(value, 100 - u16::from(lag));
        }
    }
}
