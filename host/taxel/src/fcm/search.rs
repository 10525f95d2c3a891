//! Searches for weights by which a map classifies labelled touches, one weight at a time.
//!
//! The loss of a touch is the shortfall of its own intention from a lead of `MARGIN` over the strongest other
//! class; `none` counts as a class whose activation is the level from which an intention may lead. The arithmetic
//! is that of the board, so the result of the [`Descent`] is the same everywhere.

use super::board::BoardMap;
use super::descent::Descent;
use super::map::MapFile;
use super::touches::{Labelled, NONE, Touches};
use crate::error::Result;
use crate::text::progress::{Progress, Unit};
use taxel_core::intent::Leading;

/// Required lead.
const MARGIN: f64 = 0.2;
/// Activation from which an intention may lead, as in a scene.
const LEVEL: f64 = 0.5;
/// The search.
const DESCENT: Descent = Descent { moves: &[20, 10, 5, 2, 1], pull: 0.001 };

/// Judgement of touches by a map.
#[derive(Debug, Clone)]
pub struct Verdict {
    /// `confusion[label][answer]`, in the order of the classes.
    pub confusion: Vec<Vec<usize>>,
    /// Mean loss.
    pub loss: f64,
}

impl Verdict {
    /// Share of right answers.
    pub fn accuracy(&self) -> f64 {
        let right: usize = self.confusion.iter().enumerate().map(|(class, row)| row[class]).sum();
        right as f64 / self.confusion.iter().flatten().sum::<usize>().max(1) as f64
    }
}

/// Classifies touches by a map.
pub fn judge<'a>(
    file: &MapFile,
    classes: &[String],
    touches: impl IntoIterator<Item = &'a Labelled>,
) -> Result<Verdict> {
    let map = BoardMap::build(file)?;
    let numbers: Vec<Option<usize>> = classes.iter().map(|class| file.find(class)).collect();
    let mut judged = Verdict { confusion: vec![vec![0; classes.len()]; classes.len()], loss: 0.0 };
    let mut count = 0usize;
    for touch in touches {
        let run = map.infer(&touch.start);
        let score = |class: usize| match numbers[class].filter(|_| classes[class] != NONE) {
            Some(concept) => map.value(run.state[concept]),
            None => LEVEL,
        };
        let mut scores: Vec<f64> = (0..classes.len()).map(score).collect();
        // What hits may also threaten; then the attack is announced.
        let at = |of: Leading| classes.iter().position(|class| class == of.as_str());
        if let (Some(attack), Some(threat)) = (at(Leading::Attack), at(Leading::Threat))
            && scores[attack] >= LEVEL
        {
            scores[threat] = scores[threat].min(LEVEL);
        }
        let best = (0..scores.len()).rev().max_by(|a, b| scores[*a].total_cmp(&scores[*b])).unwrap_or(0);
        let other = (0..scores.len()).filter(|class| *class != touch.class).map(|class| scores[class]);
        judged.loss += (MARGIN + other.fold(f64::MIN, f64::max) - scores[touch.class]).max(0.0);
        judged.confusion[touch.class][best] += 1;
        count += 1;
    }
    judged.loss /= count.max(1) as f64;
    Ok(judged)
}

/// Searches for weights on the touches for whose numbers `is_taken` is true.
pub fn search(file: &MapFile, touches: &Touches, is_taken: impl Fn(usize) -> bool) -> Result<MapFile> {
    let taken: Vec<&Labelled> =
        touches.touches.iter().enumerate().filter(|(at, _)| is_taken(*at)).map(|(_, touch)| touch).collect();
    let mut progress = Progress::of("learning", Unit::Steps("weights tried"), None);
    let mut tried = 0;
    DESCENT.run(
        file,
        |_| true,
        |map| {
            progress.at(tried);
            tried += 1;
            Ok(judge(map, &touches.classes, taken.iter().copied())?.loss)
        },
    )
}
