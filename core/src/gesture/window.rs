//! The touch over a window of frames, in sums that each frame is added to.

use super::cells::Cells;
use super::course::{COURSE, Course};
use super::grid::{GRID, Grid};
use super::history::History;
use super::log::log2;
use super::signal::{SIGNALS, Signals};

/// Features of a window.
pub const FEATURES: usize = SIGNALS * COURSE + GRID + 1;

/// The features of a window: those of each course, those of the grid, log2 of the number of frames (Q8).
pub type Features = [u16; FEATURES];

/// Most frames of a window; the sums have room for as many.
pub const LONGEST: u32 = 1024;

/// Sums over the frames of a window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Window {
    frames: u32,
    courses: [Course; SIGNALS],
    grid: Grid,
}

impl Default for Window {
    fn default() -> Self {
        Window::new()
    }
}

impl Window {
    /// No frame yet.
    pub const fn new() -> Window {
        Window { frames: 0, courses: [const { Course::new() }; SIGNALS], grid: Grid::new() }
    }

    /// Frames so far, at most [`LONGEST`].
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Adds a frame after that of `before`, whose numbers are not in the history yet. A full window stays as it is.
    pub fn add(&mut self, cells: &Cells, before: &Cells, signals: &Signals, history: &History) {
        if self.frames >= LONGEST {
            return;
        }
        for ((index, course), value) in self.courses.iter_mut().enumerate().zip(signals) {
            course.add(*value, self.frames, history.back(index));
        }
        self.grid.add(cells, before, self.frames);
        self.frames += 1;
    }

    /// The features of the frames so far.
    pub fn features(&self) -> Features {
        let courses = self.courses.iter().flat_map(|course| course.features(self.frames));
        let all = courses.chain(self.grid.features(self.frames)).chain([log2(self.frames.into())]);
        let mut features = [0; FEATURES];
        features.iter_mut().zip(all).for_each(|(place, feature)| *place = feature);
        features
    }
}
