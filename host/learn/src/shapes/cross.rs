//! Cross-validation of a recipe.

use super::data::Example;
use crate::stratified::stratified;
use taxel::files::bases::BoardGallery;
use taxel::text::progress::{Progress, Unit};
use taxel_core::shape::Recognised;

/// Assigns examples to folds. Returns the fold of each example.
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

/// Classifies each example by a gallery that `train` builds from the other folds.
pub fn predict(
    examples: &[&Example],
    fold: &[usize],
    train: impl Fn(&[&Example]) -> BoardGallery,
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
    let galleries: Vec<BoardGallery> = (0..folds).map(&mut gallery).collect();
    examples.iter().zip(fold).map(|(example, fold)| galleries[*fold].recognise(&example.descriptor)).collect()
}

/// Folds for the completion of a gallery.
pub const FOLDS: usize = 5;
/// Seed of the assignment to folds.
pub const SEED: u64 = 1;
