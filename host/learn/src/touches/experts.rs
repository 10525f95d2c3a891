//! Trains the experts of a model, each on touches of its age, the ages of hand-over, and the confidence.
//!
//! Hand-over and confidence are fitted to decisions about groups left out of the training data.

use super::calibration::{ConfidenceFit, Judged};
use super::course::Course;
use super::ridge::Ridge;
use super::settings::{EARLY, TrainSettings};
use std::ops::Range;
use taxel::learn::model::LinearExpert;
use taxel_core::gesture::{Features, LEADS};

/// A training example.
#[derive(Debug, Clone, Copy)]
pub struct TouchExample<'a> {
    /// Training data of the touch.
    pub course: &'a Course,
    /// Class of the example.
    pub class: usize,
    /// Group that is left out together.
    pub group: &'a str,
}

/// A trained expert.
#[derive(Debug, Clone, PartialEq)]
pub struct Trained {
    /// First age at which it decides, frames.
    pub from: usize,
    /// Linear classifier.
    pub ridge: Ridge,
    /// Confidence at each lead, by first age.
    pub rows: Vec<(usize, [f64; LEADS])>,
}

impl Trained {
    /// The expert, as a model has it.
    pub fn expert(&self) -> LinearExpert<'_> {
        let Ridge { middle, deviation, weights, offsets } = &self.ridge;
        LinearExpert { from: self.from, middle, deviation, weights, offsets, confidence: &self.rows }
    }
}

/// Most folds of groups.
const PARTS: usize = 7;

/// Least number of decisions for a fit of the confidence.
const FEWEST: usize = 50;

/// Trains the experts, ordered by age.
pub fn train_experts(
    examples: &[TouchExample<'_>],
    classes: usize,
    settings: &TrainSettings,
) -> Vec<Trained> {
    let trials = trials(examples, classes, settings);
    let ridges = fit(examples, classes, settings);
    let ages = ages(&trials);
    let from = if trials.is_empty() { assumed(settings) } else { handovers(&trials, &ages, ridges.len()) };
    let spans = (0..from.len()).map(|k| from[k]..from.get(k + 1).copied().unwrap_or(usize::MAX));
    let each = ridges.into_iter().zip(spans).enumerate().map(|(expert, (ridge, span))| {
        let rows = confidence(&trials, &ages, expert, from.len(), &span, settings.concludes);
        Trained { from: span.start, ridge, rows }
    });
    each.collect()
}

/// Decisions of all experts about a left-out touch after some frames.
struct Trial {
    frames: usize,
    over: bool,
    /// Result of each expert: right or wrong, and lead.
    decided: Vec<(bool, f64)>,
}

/// Decisions about each fold by experts trained on the others; none for a single group.
fn trials(examples: &[TouchExample<'_>], classes: usize, settings: &TrainSettings) -> Vec<Trial> {
    let mut groups: Vec<&str> = examples.iter().map(|example| example.group).collect();
    groups.sort();
    groups.dedup();
    if groups.len() < 2 {
        return Vec::new();
    }
    let part = |example: &TouchExample<'_>| groups.binary_search(&example.group).unwrap_or(0) % PARTS;
    let mut trials = Vec::new();
    for apart in 0..groups.len().min(PARTS) {
        let (asked, known): (Vec<TouchExample<'_>>, Vec<_>) =
            examples.iter().partition(|example| part(example) == apart);
        let ridges = fit(&known, classes, settings);
        for TouchExample { course, class, .. } in asked {
            let decided = |features: &Features| ridges.iter().map(|r| judge(r, features, class)).collect();
            trials.extend(course.beginnings.iter().map(|(frames, features)| Trial {
                frames: *frames,
                over: false,
                decided: decided(features),
            }));
            trials.push(Trial { frames: course.frames, over: true, decided: decided(&course.whole) });
        }
    }
    trials
}

/// Classifier of each expert, by age.
fn fit(examples: &[TouchExample<'_>], classes: usize, settings: &TrainSettings) -> Vec<Ridge> {
    let learn = |of: &dyn Fn(&Course) -> Vec<Features>| {
        let windows: Vec<(Features, usize)> = examples
            .iter()
            .flat_map(|example| of(example.course).into_iter().map(|features| (features, example.class)))
            .collect();
        let windows: Vec<(&Features, usize)> = windows.iter().map(|(f, class)| (f, *class)).collect();
        Ridge::fit(&windows, classes, settings.penalty, settings.balance)
    };
    let mut ridges: Vec<Ridge> = (0..EARLY)
        .filter(|early| settings.early[*early].is_some())
        .map(|early| learn(&|course| course.early[early].clone()))
        .collect();
    ridges.push(learn(&|course| std::iter::once(course.whole).chain(course.more.iter().copied()).collect()));
    ridges
}

/// True if a classifier decides for this class, and its lead.
fn judge(ridge: &Ridge, features: &Features, class: usize) -> (bool, f64) {
    let mut scores: Vec<(f64, usize)> = ridge.scores(features).into_iter().zip(0..).collect();
    scores.sort_by(|a, b| b.0.total_cmp(&a.0));
    (scores[0].1 == class, scores[0].0 - scores[1].0)
}

/// Ages of the beginnings in the trials.
fn ages(trials: &[Trial]) -> Vec<usize> {
    let mut ages: Vec<usize> = trials.iter().filter(|trial| !trial.over).map(|trial| trial.frames).collect();
    ages.sort_unstable();
    ages.dedup();
    ages
}

/// First age of each expert: the ages with the most right decisions.
fn handovers(trials: &[Trial], ages: &[usize], experts: usize) -> Vec<usize> {
    let right: Vec<Vec<usize>> = (0..experts)
        .map(|expert| {
            let at = |age: &usize| {
                trials.iter().filter(|t| !t.over && t.frames == *age && t.decided[expert].0).count()
            };
            ages.iter().map(at).collect()
        })
        .collect();
    let (_, starts) = best(&right, 0);
    // If touches are too short for all experts, the later ones start beyond the ages seen.
    let beyond = |start: usize| ages.last().map_or(0, |last| last + 1 + start - ages.len());
    let from = starts.into_iter().map(|start| ages.get(start).copied().unwrap_or_else(|| beyond(start)));
    let mut from: Vec<usize> = from.collect();
    from[0] = 0;
    from
}

/// Most right decisions from the age with index `start` on, if the first expert starts there, and the starts
/// of all experts. Each expert has at least one age, as far as there are enough.
fn best(right: &[Vec<usize>], start: usize) -> (usize, Vec<usize>) {
    let own = &right[0][start.min(right[0].len())..];
    if right.len() == 1 {
        return (own.iter().sum(), vec![start]);
    }
    let mut chosen = (0, Vec::new());
    let mut until = 0;
    for (next, count) in (start + 1..).zip(own) {
        until += count;
        let (later, starts) = best(&right[1..], next);
        if chosen.1.is_empty() || until + later > chosen.0 {
            chosen = (until + later, starts);
        }
    }
    if chosen.1.is_empty() {
        chosen.1 = (start + 1..start + right.len()).collect();
    }
    chosen.1.insert(0, start);
    chosen
}

/// Ages without left-out groups: each expert from the shortest of its windows on, the last one after all
/// others'.
fn assumed(settings: &TrainSettings) -> Vec<usize> {
    let early: Vec<_> = settings.early.iter().flatten().collect();
    let mut from: Vec<usize> = early.iter().map(|windows| windows.shortest).collect();
    from.extend(early.last().map(|windows| windows.longest + 1).or(Some(0)));
    from[0] = 0;
    from
}

/// Confidence rows of an expert for a `span` of ages; none if there are too few decisions.
fn confidence(
    trials: &[Trial],
    ages: &[usize],
    expert: usize,
    experts: usize,
    span: &Range<usize>,
    concludes: bool,
) -> Vec<(usize, [f64; LEADS])> {
    let speaks = |trial: &&Trial| match trial.over && concludes {
        true => expert + 1 == experts,
        false => span.contains(&trial.frames),
    };
    let judged = trials.iter().filter(speaks).map(|trial| {
        let (right, lead) = trial.decided[expert];
        Judged { lead, frames: trial.frames, right }
    });
    let judged: Vec<Judged> = judged.collect();
    if judged.len() < FEWEST {
        return Vec::new();
    }
    let calibration = ConfidenceFit::fit(&judged);
    ages.iter().filter(|age| span.contains(age)).map(|age| (*age, calibration.row(*age))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_expert_hands_over_where_the_next_one_recognises_more() {
        let right = [vec![9, 8, 7, 6, 5], vec![1, 2, 8, 9, 6], vec![0, 0, 0, 9, 9]];
        assert_eq!(best(&right, 0), (9 + 8 + 8 + 9 + 9, vec![0, 2, 3]));
        assert_eq!(best(&right[..1], 0), (35, vec![0]));
        // One age for each, as far as there are enough.
        assert_eq!(best(&[vec![1], vec![1], vec![1]], 0).1, [0, 1, 2]);
    }
}
