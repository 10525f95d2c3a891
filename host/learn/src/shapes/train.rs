//! Builds a gallery from labelled touches.

use super::data::Example;
use super::discriminant::Discriminant;
use taxel::files::bases::BoardGallery;
use taxel::learn::shapes::cluster::{centres, mean};
use taxel_core::format::name;
use taxel_core::shape::{
    ConfidenceTable, DIMENSIONS, Exemplar, GALLERY_PROTOTYPES, Gallery, MEASURES, Point, Space,
};

/// Training settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Indices of the measures to use.
    pub measures: Vec<usize>,
    /// True if measures are to be selected by their benefit.
    pub select: bool,
    /// See [`Discriminant::of`].
    pub shrinkage: f64,
    /// Share of the way by which prototypes are moved towards the mean of their class, 0 to 1: with few
    /// examples, a prototype owes much to chance.
    pub pull: f64,
    /// Number of voting neighbours.
    pub k: u8,
    /// Most prototypes, at most [`GALLERY_PROTOTYPES`].
    pub prototypes: usize,
}

impl Default for Recipe {
    fn default() -> Self {
        Recipe {
            measures: (0..MEASURES).collect(),
            select: false,
            shrinkage: 0.05,
            pull: 0.0,
            k: 3,
            prototypes: GALLERY_PROTOTYPES,
        }
    }
}

/// Units of a [`Point`] per spread within a class.
const UNITS: f64 = 256.0;

/// Trains a gallery that never answers "none", without a table of confidence.
pub fn fit(examples: &[&Example], names: &[String], recipe: &Recipe) -> BoardGallery {
    let space = space(examples, recipe);
    let mut prototypes = heapless::Vec::new();
    for class in 0..names.len() {
        let members = examples.iter().filter(|example| example.class == class);
        let points: Vec<Point> = members.map(|example| space.place(&example.descriptor)).collect();
        let share = (points.len() * recipe.prototypes).div_ceil(examples.len());
        let quota = share.min(recipe.prototypes / names.len()).max(1);
        for at in pulled(centres(&points, quota), &points, recipe.pull) {
            let _ = prototypes.push(Exemplar { class: class as u8, at });
        }
    }
    Gallery {
        names: names.iter().map(|text| name(text)).collect(),
        space,
        k: recipe.k,
        reject: u16::MAX,
        confidence: ConfidenceTable::default(),
        prototypes,
    }
}

/// Moves centres towards the mean of all points of their class by a share of the way.
fn pulled(mut centres: Vec<Point>, points: &[Point], share: f64) -> Vec<Point> {
    let mean = mean(points);
    for (at, mean) in centres.iter_mut().flat_map(|centre| centre.iter_mut().zip(mean)) {
        *at = (f64::from(*at) * (1.0 - share) + f64::from(mean) * share).round() as i16;
    }
    centres
}

/// The projection of a discriminant analysis, in integers.
fn space(examples: &[&Example], recipe: &Recipe) -> Space {
    let row = |example: &&Example| recipe.measures.iter().map(|i| example.descriptor[*i].into()).collect();
    let rows: Vec<Vec<f64>> = examples.iter().map(row).collect();
    // By label: separating the labels within a merged class helps to separate the classes.
    let labels: Vec<usize> = examples.iter().map(|example| example.kind).collect();
    let classes = labels.iter().max().map_or(0, |last| last + 1);
    let found = Discriminant::of(&rows, &labels, classes, DIMENSIONS, recipe.shrinkage);
    let greatest =
        found.weights.iter().flatten().fold(0.0, |most: f64, weight| most.max(weight.abs())) * UNITS;
    // The finest step at which the greatest weight fits.
    let shift = (0..=30u8).rev().find(|shift| greatest * f64::from(*shift).exp2() < 32_767.0).unwrap_or(0);
    let spread = |values: &mut dyn Iterator<Item = f64>| {
        let mut out = [0i16; MEASURES];
        recipe.measures.iter().zip(values).for_each(|(i, value)| out[*i] = value.round() as i16);
        out
    };
    let scale = UNITS * f64::from(shift).exp2();
    let weights = found.weights.iter().map(|row| spread(&mut row.iter().map(|weight| weight * scale)));
    Space { origin: spread(&mut found.origin.iter().copied()), weights: weights.collect(), shift }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prototypes_move_towards_the_mean_of_their_class() {
        let points = [0, 10, 20, 90].map(|x| [x; DIMENSIONS]);
        let centres = || points[1..].to_vec();
        assert_eq!(pulled(centres(), &points, 0.0), centres());
        assert_eq!(pulled(centres(), &points, 0.5), [20, 25, 60].map(|x| [x; DIMENSIONS]));
        assert_eq!(pulled(centres(), &points, 1.0), [[30; DIMENSIONS]; 3]);
    }
}
