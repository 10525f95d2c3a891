//! Windows of a touch used to train an early expert.

use serde::{Deserialize, Serialize};

/// Windows of several lengths, each 1.41 times as long as the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Windows {
    /// Length of the shortest, frames.
    pub shortest: usize,
    /// Limit of the length, frames.
    pub longest: usize,
    /// Frames between the beginnings of two windows; 0 if all begin with the touch.
    pub every: usize,
}

impl Windows {
    /// The lengths.
    pub fn lengths(&self) -> Vec<usize> {
        ladder(self.shortest).take_while(|length| *length <= self.longest).collect()
    }

    /// Beginnings of windows in a touch with this many frames.
    pub fn starts(&self, frames: usize) -> Vec<usize> {
        match self.every {
            0 => vec![0],
            every => (0..frames).step_by(every).collect(),
        }
    }
}

/// Numbers of frames from `first` on, each 1.41 times the one before, rounded.
pub fn ladder(first: usize) -> impl Iterator<Item = usize> {
    let mut before = 0;
    (0..).map(move |step| (first.max(1) as f64 * 2f64.powf(f64::from(step) / 2.0)).round() as usize).filter(
        move |length| {
            let longer = *length > before;
            before = *length;
            longer
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_grow_and_windows_begin_where_they_are_asked_to() {
        assert_eq!(ladder(1).take(7).collect::<Vec<_>>(), [1, 2, 3, 4, 6, 8, 11]);
        let windows = Windows { shortest: 5, longest: 28, every: 50 };
        assert_eq!(windows.lengths(), [5, 7, 10, 14, 20, 28]);
        assert_eq!(windows.starts(120), [0, 50, 100]);
        assert_eq!(Windows { every: 0, ..windows }.starts(120), [0]);
    }
}
