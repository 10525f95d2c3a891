//! Cross-validation of a recipe.

use super::data::Example;
use super::train::Known;
use crate::learn::folds::stratified;
use crate::progress::{Progress, Unit};
use taxel_core::shape::Recognised;

/// Splits examples into those that a fold trains on and those that it is tested on; the fold of each example.
pub fn deal(examples: &[&Example], folds: usize, seed: u64) -> Vec<usize> {
    // Examples of one unit share their class.
    let mut units: Vec<(usize, usize)> =
        examples.iter().map(|example| (example.unit, example.class)).collect();
    units.sort();
    units.dedup();
    let classes: Vec<usize> = units.iter().map(|unit| unit.1).collect();
    let fold = stratified(&classes, folds, seed);
    let of =
        |example: &&Example| units.binary_search(&(example.unit, example.class)).map_or(0, |unit| fold[unit]);
    examples.iter().map(of).collect()
}

/// What each example is found to be by a gallery that `train` makes of the other folds.
pub fn predict(
    examples: &[&Example],
    fold: &[usize],
    train: impl Fn(&[&Example]) -> Known,
) -> Vec<Recognised> {
    let folds = fold.iter().max().map_or(0, |last| last + 1);
    let others = |n: usize| -> Vec<&Example> {
        examples.iter().zip(fold).filter(|(_, fold)| **fold != n).map(|(example, _)| *example).collect()
    };
    let mut progress = Progress::of("learning", Unit::Steps("folds"), Some(folds as u64));
    let mut gallery = |n: usize| {
        progress.at(n as u64);
        train(&others(n))
    };
    let galleries: Vec<Known> = (0..folds).map(&mut gallery).collect();
    examples.iter().zip(fold).map(|(example, fold)| galleries[*fold].recognise(&example.descriptor)).collect()
}

/// Folds by which a gallery is completed.
pub const FOLDS: usize = 5;
/// Draws who is tested when.
pub const SEED: u64 = 1;
