//! What a touch is, while it goes on.

use super::cells::{CELLS, Cells, Sheet};
use super::history::History;
use super::model::{CLASSES, Model, Scores};
use super::signal::signals;
use super::window::{LONGEST, Window};

/// Recognises touches of one sheet by a model: what the whole touch so far scores, and to that what each of its parts
/// scored that is complete.
#[derive(Debug, Clone, Copy)]
pub struct Touches<'a> {
    model: Model<'a>,
    sheet: Sheet,
}

/// A touch so far.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TouchState {
    history: History,
    before: Cells,
    whole: Window,
    part: Window,
    /// What the complete parts scored.
    parts: Scores,
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
            history: History::new(),
            before: [0; CELLS],
            whole: Window::new(),
            part: Window::new(),
            parts: [0; CLASSES],
        }
    }

    /// A touch begins.
    pub fn reset(&mut self) {
        *self = const { TouchState::new() };
    }
}

/// What a touch is taken for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decision {
    /// The class that scores most; of equals the first.
    pub class: usize,
    /// What each class scores.
    pub scores: Scores,
    /// By how much it leads, Q18 of the natural logarithm of the odds against the second.
    pub lead: u32,
}

impl<'a> Touches<'a> {
    /// For a sheet of that many rows and columns.
    pub const fn new(model: Model<'a>, rows: u16, columns: u16) -> Touches<'a> {
        Touches { model, sheet: Sheet::new(rows, columns) }
    }

    /// With pressures in another unit: as many counts of the model's sheet per count, Q8, at most 4096.
    pub fn with_gain(self, gain: u16) -> Touches<'a> {
        Touches { sheet: self.sheet.with_gain(gain), ..self }
    }

    /// The model.
    pub fn model(&self) -> &Model<'a> {
        &self.model
    }

    /// Adds a frame: an image of rows of pressures. After [`LONGEST`] frames the touch begins anew.
    pub fn process(&self, state: &mut TouchState, image: &[u16]) {
        let cells = self.sheet.cells(image);
        if state.whole.frames() >= LONGEST {
            state.reset();
        }
        if state.whole.frames() == 0 {
            state.before = cells;
        }
        let TouchState { history, before, whole, part, parts } = state;
        let signals = signals(&cells, before, self.model.pressed());
        whole.add(&cells, before, &signals, history);
        part.add(&cells, before, &signals, history);
        history.push(&signals);
        *before = cells;
        if part.frames() == u32::from(self.model.part()) {
            let scores = self.model.scores(&part.features());
            parts.iter_mut().zip(scores).for_each(|(sum, score)| *sum = sum.saturating_add(score));
            *part = const { Window::new() };
        }
    }

    /// What the touch is taken for so far.
    pub fn decide(&self, state: &TouchState) -> Decision {
        let mut scores = self.model.scores(&state.whole.features());
        scores.iter_mut().zip(&state.parts).for_each(|(sum, score)| *sum = sum.saturating_add(*score));
        let mut leading = (0, i32::MIN);
        let mut second = i32::MIN;
        for (class, score) in scores.iter().copied().enumerate().take(self.model.classes()) {
            if score > leading.1 {
                (second, leading) = (leading.1, (class, score));
            } else {
                second = second.max(score);
            }
        }
        Decision { class: leading.0, scores, lead: leading.1.abs_diff(second) }
    }
}
