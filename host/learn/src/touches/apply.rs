//! Applies a model to recorded touches as the board does.

use super::data::{Data, Touch};
use anyhow::{Result, bail};
use taxel::text::progress::{Progress, Unit};
use taxel_core::format::Q15;
use taxel_core::gesture::{Decision, Model, TouchClassifier, TouchState};

/// A decision about a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// The class, in the numbering of the data.
    pub class: usize,
    /// Share of right decisions among such touches; none if the model does not know.
    pub confidence: Option<f64>,
}

/// Decisions during a touch and at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Applied {
    /// Decision at its end.
    pub last: Taken,
    /// Number of its frames.
    pub frames: usize,
    /// Decisions after the requested numbers of frames, as far as the touch lasts.
    pub early: Vec<(usize, Taken)>,
}

impl Applied {
    /// Decision after this many frames, or at the end of a shorter touch.
    pub fn after(&self, frames: usize) -> Taken {
        let found = self.early.binary_search_by_key(&frames, |(at, _)| *at);
        found.map_or(self.last, |place| self.early[place].1)
    }
}

/// Applies a model to touches, with a decision after each of `times` frames, in ascending order.
pub fn apply(model: &Model<'_>, data: &Data, touches: &[&Touch], times: &[usize]) -> Result<Vec<Applied>> {
    let names: Vec<String> =
        (0..model.classes()).filter_map(|class| model.name(class)).map(|n| n.to_string()).collect();
    let place = |name: &String| data.classes.iter().position(|known| known == name);
    let Some(places) = names.iter().map(place).collect::<Option<Vec<usize>>>() else {
        bail!("the model knows {}, the labels {}", names.join(", "), data.classes.join(", "));
    };
    let recogniser = TouchClassifier::new(*model, data.rows, data.columns);
    let mut progress = Progress::of("applying the model", Unit::Steps("touches"), Some(touches.len() as u64));
    let each = (0..).zip(touches).map(|(done, touch)| {
        progress.at(done);
        follow(&recogniser, data.frames(touch), times, &places)
    });
    Ok(each.collect())
}

fn follow<'a>(
    recogniser: &TouchClassifier<'_>,
    frames: impl Iterator<Item = &'a [u16]>,
    times: &[usize],
    places: &[usize],
) -> Applied {
    let taken = |decision: Decision| Taken {
        class: places[decision.class],
        confidence: decision.confidence.map(Q15::to_f64),
    };
    let mut state = TouchState::default();
    let (mut early, mut count) = (Vec::new(), 0);
    for (number, frame) in (1..).zip(frames) {
        recogniser.process(&mut state, frame);
        if times.binary_search(&number).is_ok() {
            early.push((number, taken(recogniser.decide(&state))));
        }
        count = number;
    }
    Applied { last: taken(recogniser.conclude(&state)), frames: count, early }
}
