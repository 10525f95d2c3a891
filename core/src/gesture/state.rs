//! State of a touch: sums over its frames.

use super::bands::{BANDS, Bands};
use super::cells::{CELLS, Cells};
use super::course::{COURSE, Course};
use super::grid::{GRID, Grid};
use super::history::History;
use super::motion::{MOTION, Motion};
use super::signal::{SIGNALS, signals};
use crate::format::log2;

/// Number of features of a touch.
pub const FEATURES: usize = SIGNALS * COURSE + GRID + MOTION + BANDS + 1;

/// Features of a touch: those of each course, of the grid, of motion and of rhythm, then log2 of the number
/// of frames (Q8).
pub type Features = [u16; FEATURES];

/// Greatest number of frames of a touch; the sums have room for that many.
pub const LONGEST: u32 = 1024;

/// Sums over the frames of a touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TouchState {
    frames: u32,
    before: Cells,
    history: History,
    courses: [Course; SIGNALS],
    grid: Grid,
    motion: Motion,
    bands: Bands,
}

impl Default for TouchState {
    fn default() -> Self {
        TouchState::new()
    }
}

impl TouchState {
    /// State before the first frame.
    pub const fn new() -> TouchState {
        TouchState {
            frames: 0,
            before: [0; CELLS],
            history: History::new(),
            courses: [const { Course::new() }; SIGNALS],
            grid: Grid::new(),
            motion: Motion::new(),
            bands: Bands::new(),
        }
    }

    /// Starts a new touch.
    pub fn reset(&mut self) {
        *self = const { TouchState::new() };
    }

    /// Number of frames so far, at most [`LONGEST`].
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Adds a frame; a cell above `pressed` counts as touched. After [`LONGEST`] frames the sums start again.
    pub fn add(&mut self, cells: &Cells, pressed: u16) {
        if self.frames >= LONGEST {
            self.reset();
        }
        if self.frames == 0 {
            self.before = *cells;
        }
        let change = self.motion.add(cells, &self.before);
        let (total, signals) = signals(cells, change, pressed);
        for ((index, course), value) in self.courses.iter_mut().enumerate().zip(signals) {
            course.add(value, self.frames, self.history.back(index));
        }
        self.history.push(&signals);
        self.grid.add(cells, &self.before);
        self.bands.add(total, self.frames);
        self.before = *cells;
        self.frames += 1;
    }

    /// Returns the features of the frames so far.
    pub fn features(&self) -> Features {
        let mut features = [0; FEATURES];
        let mut places = features.iter_mut();
        let mut put =
            |values: &[u16]| values.iter().zip(&mut places).for_each(|(value, place)| *place = *value);
        self.courses.iter().for_each(|course| put(&course.features(self.frames)));
        put(&self.grid.features(self.frames));
        put(&self.motion.features());
        put(&self.bands.features());
        put(&[log2(self.frames.into())]);
        features
    }
}
