//! What a touch is, while it goes on.

use super::cells::Sheet;
use super::model::{Model, Scores};
use super::state::TouchState;

/// Recognises touches of one sheet by a model.
#[derive(Debug, Clone, Copy)]
pub struct Touches<'a> {
    model: Model<'a>,
    sheet: Sheet,
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

    /// Adds a frame: an image of rows of pressures. After [`LONGEST`](super::LONGEST) frames the touch begins anew.
    pub fn process(&self, state: &mut TouchState, image: &[u16]) {
        state.add(&self.sheet.cells(image), self.model.pressed());
    }

    /// What the touch is taken for so far.
    pub fn decide(&self, state: &TouchState) -> Decision {
        let scores = self.model.scores(&state.features());
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
