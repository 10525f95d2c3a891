//! Trains a complete gallery.

use super::calibrate::calibrate;
use super::cross::{FOLDS, SEED, deal, predict};
use super::data::Example;
use super::select::select;
use super::train::{Known, Recipe, fit};
use taxel_core::shape::Recognised;

/// A gallery of all examples, completed by five folds of them. Also returns the results of the folds.
pub fn trained(examples: &[&Example], names: &[String], recipe: &Recipe) -> (Known, Vec<Recognised>) {
    let recipe = &if recipe.select { select(examples, names, recipe) } else { recipe.clone() };
    let found = predict(examples, &deal(examples, FOLDS, SEED), |others| fit(others, names, recipe));
    let mut gallery = fit(examples, names, recipe);
    calibrate(&mut gallery, examples, &found);
    (gallery, found)
}
