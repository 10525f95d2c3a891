//! Frame rate in the board's own time.

use std::collections::VecDeque;
use taxel_core::format::Micros;

/// Times of the frames of the last second.
#[derive(Debug, Default, Clone)]
pub struct Rate(VecDeque<Micros>);

impl Rate {
    /// Adds a frame.
    pub fn add(&mut self, time: Micros) {
        if self.0.back().is_some_and(|last| *last >= time) {
            self.0.clear();
        }
        self.0.push_back(time);
        while self.0.front().is_some_and(|first| time.since(*first) > 1_000_000) {
            self.0.pop_front();
        }
    }

    /// Frames per second; 0 before two frames.
    pub fn hz(&self) -> f64 {
        match (self.0.front(), self.0.back()) {
            (Some(first), Some(last)) if last > first => {
                (self.0.len() - 1) as f64 * 1e6 / last.since(*first) as f64
            }
            _ => 0.0,
        }
    }

    /// Time of the last frame.
    pub fn last(&self) -> Option<Micros> {
        self.0.back().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_counted_by_their_own_time() {
        let mut rate = Rate::default();
        (0..500).for_each(|frame| rate.add(Micros(frame * 5128)));
        assert!((rate.hz() - 195.0).abs() < 0.01);
        rate.add(Micros(3));
        assert_eq!((rate.hz(), rate.last()), (0.0, Some(Micros(3))));
    }
}
