//! Recognition of a touch on one sheet.

use super::cells::Sheet;
use super::expert::Expert;
use super::expert::Scores;
use super::model::Model;
use super::model_error::CLASSES;
use super::state::TouchState;
use crate::format::Q15;

/// Recognises touches of one sheet by a model.
#[derive(Debug, Clone, Copy)]
pub struct TouchClassifier<'a> {
    model: Model<'a>,
    sheet: Sheet,
}

/// Classification of a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decision {
    /// Class with the greatest score; of equal ones the first.
    pub class: usize,
    /// Scores of the classes.
    pub scores: Scores,
    /// Lead over the score of the second class, Q18.
    pub lead: u32,
    /// Share of touches of that age and lead that are classified correctly; none if the model does not know.
    pub confidence: Option<Q15>,
}

impl<'a> TouchClassifier<'a> {
    /// Recognises touches on a sheet of that many rows and columns.
    pub const fn new(model: Model<'a>, rows: u16, columns: u16) -> TouchClassifier<'a> {
        TouchClassifier { model, sheet: Sheet::new(rows, columns) }
    }

    /// Sets the gain: counts of the model's sheet per count of the images, Q8, at most 4096.
    pub fn with_gain(self, gain: u16) -> TouchClassifier<'a> {
        TouchClassifier { sheet: self.sheet.with_gain(gain), ..self }
    }

    /// The model.
    pub fn model(&self) -> &Model<'a> {
        &self.model
    }

    /// Adds a frame: an image of rows of pressures. After [`LONGEST`](super::LONGEST) frames the sums start
    /// again.
    pub fn process(&self, state: &mut TouchState, image: &[u16]) {
        state.add(&self.sheet.cells(image), self.model.pressed());
    }

    /// Classifies a touch in progress by its frames so far.
    pub fn decide(&self, state: &TouchState) -> Decision {
        self.by(self.model.expert(state.frames()), state)
    }

    /// Classifies a touch that is over.
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
