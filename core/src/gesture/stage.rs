//! What a touch is, while it goes on.

use super::cells::Sheet;
use super::expert::Expert;
use super::model::{CLASSES, Model, Scores};
use super::state::TouchState;
use crate::format::Q15;

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
    /// By how much it scores more than the second, Q18.
    pub lead: u32,
    /// The share of touches of that age and lead that are what they are taken for; none: the model does not
    /// know.
    pub confidence: Option<Q15>,
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

    /// Adds a frame: an image of rows of pressures. After [`LONGEST`](super::LONGEST) frames the touch begins
    /// anew.
    pub fn process(&self, state: &mut TouchState, image: &[u16]) {
        state.add(&self.sheet.cells(image), self.model.pressed());
    }

    /// What the touch, which goes on, is taken for so far.
    pub fn decide(&self, state: &TouchState) -> Decision {
        self.by(self.model.expert(state.frames()), state)
    }

    /// What the touch, which is over, is taken for.
    pub fn conclude(&self, state: &TouchState) -> Decision {
        self.by(self.model.concluding(state.frames()), state)
    }

    fn by(&self, expert: Option<&Expert<'_>>, state: &TouchState) -> Decision {
        let scores = expert.map_or([0; CLASSES], |expert| expert.scores(&state.features()));
        let mut leading = (0, i32::MIN);
        let mut second = i32::MIN;
        for (class, score) in scores.iter().copied().enumerate().take(self.model.classes()) {
            if score > leading.1 {
                (second, leading) = (leading.1, (class, score));
            } else {
                second = second.max(score);
            }
        }
        let lead = leading.1.abs_diff(second);
        let confidence = expert.and_then(|expert| expert.confidence(lead, state.frames()));
        Decision { class: leading.0, scores, lead, confidence }
    }
}
