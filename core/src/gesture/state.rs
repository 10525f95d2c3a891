//! A touch so far, in sums that each frame is added to.

use super::bands::{BANDS, Bands};
use super::cells::{CELLS, Cells};
use super::course::{COURSE, Course};
use super::grid::{GRID, Grid};
use super::history::History;
use super::log::log2;
use super::motion::{MOTION, Motion};
use super::signal::{SIGNALS, signals};

/// Features of a touch.
pub const FEATURES: usize = SIGNALS * COURSE + GRID + MOTION + BANDS + 1;

/// The features of a touch: those of each course, of the grid, of motion and rhythm, log2 of the number of
/// frames (Q8).
pub type Features = [u16; FEATURES];

/// Most frames of a touch; the sums have room for as many.
pub const LONGEST: u32 = 1024;

/// A touch so far.
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
    /// No frame yet.
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

    /// A touch begins.
    pub fn reset(&mut self) {
        *self = const { TouchState::new() };
    }

    /// Frames so far, at most [`LONGEST`].
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Adds a frame; a cell above `pressed` counts as touched. After [`LONGEST`] frames the touch begins anew.
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

    /// The features of the frames so far.
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
