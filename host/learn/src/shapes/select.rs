//! Selects measures, because few images support only few of them.

use super::cross::{FOLDS, deal, predict};
use super::data::Example;
use super::train::{Recipe, fit};
use taxel_core::shape::MEASURES;

/// Assignments to folds by which measures are compared.
const DRAWS: u64 = 3;
/// Least benefit of another measure: half a percent of right answers.
const WORTH: f64 = 0.005;

/// The recipe with the measures found by forward selection: starting with none, the most helpful one is added
/// as long as it helps. The score is that of five folds, assigned three times.
pub fn select(examples: &[&Example], names: &[String], recipe: &Recipe) -> Recipe {
    let mut best = (f64::MIN, Recipe { measures: Vec::new(), ..recipe.clone() });
    loop {
        let grown = (0..MEASURES).filter(|measure| !best.1.measures.contains(measure)).map(|measure| {
            let mut grown = best.1.clone();
            grown.measures.push(measure);
            (score(examples, names, &grown), grown)
        });
        let Some(grown) = grown.max_by(|a, b| a.0.total_cmp(&b.0)) else { return best.1 };
        if grown.0 < best.0 + WORTH {
            return best.1;
        }
        best = grown;
    }
}

/// Right answers minus wrong ones, each weighted by its share of the votes, which distinguishes recipes with
/// equally many right answers.
fn score(examples: &[&Example], names: &[String], recipe: &Recipe) -> f64 {
    let draw = |seed| -> f64 {
        let found = predict(examples, &deal(examples, FOLDS, seed), |others| fit(others, names, recipe));
        let votes = found.iter().zip(examples).map(|(found, example)| {
            let right = found.class.map(usize::from) == Some(example.class);
            if right { found.share.to_f64() } else { -found.share.to_f64() }
        });
        votes.sum()
    };
    (0..DRAWS).map(draw).sum::<f64>() / (DRAWS as f64 * examples.len() as f64)
}
