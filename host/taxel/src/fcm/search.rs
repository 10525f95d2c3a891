//! Searches for weights by which a map classifies labelled touches, one weight at a time.
//!
//! The loss of a touch is the shortfall of its own intention from a lead of `MARGIN` over the strongest other
//! class; `none` counts as a class whose activation is the level from which an intention may lead. A weight
//! is moved by 0.2, then 0.1, 0.05, 0.02 and 0.01 wherever that lowers the mean loss (plus the cost of
//! leaving the expert's weights), in the order of the map, until no move helps. No weight changes its sign or
//! becomes 0, no edge is added, and `fixed` weights stay. The arithmetic is that of the board, so the result
//! is the same everywhere.

use super::board::BoardMap;
use super::map::MapFile;
use super::touches::{Labelled, NONE, Touches};
use super::weight::Weight;
use crate::error::Result;
use crate::text::progress::{Progress, Unit};
use taxel_core::intent::Leading;

/// Required lead.
const MARGIN: f64 = 0.2;
/// Activation from which an intention may lead, as in a scene.
const LEVEL: f64 = 0.5;
/// Loss per unit of movement over all weights, so that useless moves are not made.
const PULL: f64 = 0.001;
/// Moves, in hundredths.
const MOVES: [i64; 5] = [20, 10, 5, 2, 1];
/// Most rounds over all weights with one size of move.
const ROUNDS: usize = 20;

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
    let hundredths = |value: f64| (value * 100.0).round() as i64;
    let expert: Vec<i64> = file.edge.iter().map(|edge| hundredths(edge.weight.value())).collect();
    let free: Vec<usize> = (0..expert.len()).filter(|at| !file.edge[*at].fixed && expert[*at] != 0).collect();
    let mut now = expert.clone();
    let cost = |weights: &[i64]| -> Result<f64> {
        let moved: i64 = weights.iter().zip(&expert).map(|(w, e)| (w - e).abs()).sum();
        let judged = judge(&with(file, weights, &expert), &touches.classes, taken.iter().copied())?;
        Ok(judged.loss + PULL * moved as f64 / 100.0)
    };
    let mut progress = Progress::of("learning", Unit::Steps("weights tried"), None);
    let mut tried = 0;
    let mut least = cost(&now)?;
    for size in MOVES {
        for _ in 0..ROUNDS {
            let before = least;
            for at in &free {
                tried += 1;
                progress.at(tried);
                let sign = expert[*at].signum();
                for moved in [now[*at] + size, now[*at] - size] {
                    let kept = std::mem::replace(&mut now[*at], sign * (sign * moved).clamp(1, 100));
                    let loss = if now[*at] == kept { least } else { cost(&now)? };
                    if loss < least {
                        least = loss;
                        break;
                    }
                    now[*at] = kept;
                }
            }
            if least >= before {
                break;
            }
        }
    }
    Ok(with(file, &now, &expert))
}

/// The map with weights in hundredths; unchanged ones keep their notation.
fn with(file: &MapFile, weights: &[i64], expert: &[i64]) -> MapFile {
    let mut map = file.clone();
    for ((edge, weight), before) in map.edge.iter_mut().zip(weights).zip(expert) {
        if weight != before {
            edge.weight = Weight::Number(*weight as f64 / 100.0);
        }
    }
    map
}
