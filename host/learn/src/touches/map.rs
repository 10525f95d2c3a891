//! A fuzzy cognitive map of features and classes, for comparison with a model.
//!
//! Each of the most discriminating features is a concept with its membership in "much"; each class is a
//! concept caused by all of them; one step of the map activates the classes. The weights, in [-1, 1], are
//! learnt by gradient descent.

use super::ridge::standard;
use taxel_core::gesture::{FEATURES, Features};

/// Number of features used: with eight classes and the bias they fit a board's map.
const CONCEPTS: usize = 48;

/// Steps of gradient descent.
const STEPS: usize = 400;

/// Steepness of the sigmoid.
const LAMBDA: f64 = 2.5;

/// Class of each of the `asked` by a map learnt from `examples`.
pub fn mapped(examples: &[(&Features, usize)], classes: usize, asked: &[&Features]) -> Vec<usize> {
    let (middle, deviation) = standard(examples);
    let chosen = distinguishing(examples, classes, &middle, &deviation);
    let inputs = |f: &Features| -> Vec<f64> {
        let much = |i: &usize| sigmoid((f64::from(f[*i]) - middle[*i]) / deviation[*i]);
        chosen.iter().map(much).chain([1.0]).collect()
    };
    let rows: Vec<(Vec<f64>, usize)> = examples.iter().map(|(f, class)| (inputs(f), *class)).collect();
    let weights: Vec<Vec<f64>> = (0..classes).map(|class| learn(&rows, class)).collect();
    let best = |f: &&Features| {
        let row = inputs(f);
        let activation = |class: &usize| dot(&weights[*class], &row);
        (0..classes).max_by(|a, b| activation(a).total_cmp(&activation(b))).unwrap_or(0)
    };
    asked.iter().map(best).collect()
}

fn sigmoid(x: f64) -> f64 {
    1.0 / (1.0 + (-LAMBDA * x).exp())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Weights towards one class.
fn learn(rows: &[(Vec<f64>, usize)], class: usize) -> Vec<f64> {
    let mut weights = vec![0.0; rows.first().map_or(0, |(row, _)| row.len())];
    for step in 0..STEPS {
        let mut slope = vec![0.0; weights.len()];
        for (row, own) in rows {
            let want = if *own == class { 1.0 } else { 0.0 };
            let error = sigmoid(dot(&weights, row)) - want;
            slope.iter_mut().zip(row).for_each(|(sum, input)| *sum += error * input / rows.len() as f64);
        }
        let rate = 4.0 / (1.0 + step as f64 / 50.0);
        weights.iter_mut().zip(slope).for_each(|(w, slope)| *w = (*w - rate * slope).clamp(-1.0, 1.0));
    }
    weights
}

/// Features whose class means differ most relative to their deviation.
fn distinguishing(
    examples: &[(&Features, usize)],
    classes: usize,
    middle: &[f64],
    deviation: &[f64],
) -> Vec<usize> {
    let mut counts = vec![0usize; classes];
    examples.iter().for_each(|(_, class)| counts[*class] += 1);
    let between = |i: usize| -> f64 {
        let mut sums = vec![0.0; classes];
        examples.iter().for_each(|(f, class)| sums[*class] += (f64::from(f[i]) - middle[i]) / deviation[i]);
        sums.iter().zip(&counts).map(|(sum, count)| sum * sum / (*count).max(1) as f64).sum()
    };
    let mut ranked: Vec<(f64, usize)> = (0..FEATURES).map(|i| (between(i), i)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    ranked.into_iter().take(CONCEPTS).map(|(_, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::touches::knn::nearest;

    #[test]
    fn classes_apart_are_distinguished_by_either() {
        let of = |class: usize, n: u16| -> Features {
            std::array::from_fn(|f| {
                500 + (n * 71 + f as u16 * 13) % 200 + if f % 3 == class { 400 } else { 0 }
            })
        };
        let all: Vec<(Features, usize)> =
            (0..60).map(|n| (of(usize::from(n % 3), n), usize::from(n % 3))).collect();
        let (known, asked) = all.split_at(30);
        let examples: Vec<_> = known.iter().map(|(f, class)| (f, *class)).collect();
        let (asked, want): (Vec<&Features>, Vec<usize>) = asked.iter().map(|(f, class)| (f, *class)).unzip();
        assert_eq!(mapped(&examples, 3, &asked), want);
        assert_eq!(nearest(&examples, 3, &asked), want);
    }
}
