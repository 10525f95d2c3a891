//! Nearest neighbours, for comparison with a model.

use super::ridge::standard;
use taxel_core::gesture::{FEATURES, Features};

/// Number of voting neighbours.
const VOTERS: usize = 5;

/// Class of each of the `asked` by a vote of its nearest `examples`, in standardised features; ties go to the
/// class of the nearest.
pub fn nearest(examples: &[(&Features, usize)], classes: usize, asked: &[&Features]) -> Vec<usize> {
    let (_, deviation) = standard(examples);
    let distance = |a: &Features, b: &Features| -> f64 {
        (0..FEATURES).map(|i| ((f64::from(a[i]) - f64::from(b[i])) / deviation[i]).powi(2)).sum()
    };
    let vote = |asked: &&Features| {
        let mut near: Vec<(f64, usize)> =
            examples.iter().map(|(f, class)| (distance(f, asked), *class)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(VOTERS);
        let votes = |class: usize| near.iter().filter(|(_, other)| *other == class).count();
        let most = (0..classes).map(votes).max().unwrap_or(0);
        near.iter().map(|(_, class)| *class).find(|class| votes(*class) == most).unwrap_or(0)
    };
    asked.iter().map(vote).collect()
}
