//! Linear classifier by least squares: for each class the plane nearest to +1 on its examples and to -1 on
//! the others.

use crate::linear::{Square, back, forward};
use taxel_core::gesture::{FEATURES, Features, LIMIT};

/// Limit of standardised features, as on the board.
const FARTHEST: f64 = LIMIT as f64 / 256.0;

/// Planes over standardised features.
#[derive(Debug, Clone, PartialEq)]
pub struct Ridge {
    /// Mean of each feature.
    pub middle: Vec<f64>,
    /// Standard deviation of each feature, plus one unit.
    pub deviation: Vec<f64>,
    /// Weight of each feature, by class.
    pub weights: Vec<Vec<f64>>,
    /// Offset of each class.
    pub offsets: Vec<f64>,
}

impl Ridge {
    /// Fits examples with their classes, 0 .. `classes`. `penalty` is the ridge penalty per window of an
    /// example. With `balance` 1 every class has the same weight, with 0 every example.
    pub fn fit(examples: &[(&Features, usize)], classes: usize, penalty: f64, balance: f64) -> Ridge {
        let (middle, deviation) = standard(examples);
        let mut counts = vec![0usize; classes];
        examples.iter().for_each(|(_, class)| counts[*class] += 1);
        let share = |class: usize| examples.len() as f64 / (classes * counts[class].max(1)) as f64;
        let weigh: Vec<f64> = (0..classes).map(|class| share(class).powf(balance)).collect();
        let size = FEATURES + 1;
        let mut normal = Square::zero(size);
        let mut wanted = vec![vec![0.0; size]; classes];
        let mut row = vec![1.0; size];
        for (features, class) in examples {
            standardise(features, &middle, &deviation, &mut row);
            let weight = weigh[*class];
            for (i, a) in row.iter().enumerate() {
                let a = a * weight;
                normal.row_mut(i)[..=i].iter_mut().zip(&row).for_each(|(sum, b)| *sum += a * b);
                for (other, wanted) in wanted.iter_mut().enumerate() {
                    wanted[i] += if other == *class { a } else { -a };
                }
            }
        }
        (0..size).for_each(|i| *normal.at(i, i) += penalty);
        let lower = normal.cholesky();
        let (mut weights, mut offsets) = (Vec::new(), Vec::new());
        for side in wanted {
            let mut plane = back(&lower, &forward(&lower, &side));
            offsets.extend(plane.pop());
            weights.push(plane);
        }
        Ridge { middle, deviation, weights, offsets }
    }

    /// Score of each class.
    pub fn scores(&self, features: &Features) -> Vec<f64> {
        let mut row = vec![1.0; FEATURES + 1];
        standardise(features, &self.middle, &self.deviation, &mut row);
        let plane = |(weights, offset): (&Vec<f64>, &f64)| {
            weights.iter().zip(&row).map(|(weight, value)| weight * value).sum::<f64>() + offset
        };
        self.weights.iter().zip(&self.offsets).map(plane).collect()
    }
}

/// Mean and standard deviation of each feature.
pub(super) fn standard(examples: &[(&Features, usize)]) -> (Vec<f64>, Vec<f64>) {
    let count = examples.len().max(1) as f64;
    let (mut middle, mut deviation) = (vec![0.0; FEATURES], vec![0.0; FEATURES]);
    for (features, _) in examples {
        middle.iter_mut().zip(features.iter()).for_each(|(sum, value)| *sum += f64::from(*value) / count);
    }
    for (features, _) in examples {
        let values = middle.iter().zip(features.iter()).map(|(middle, value)| f64::from(*value) - middle);
        deviation.iter_mut().zip(values).for_each(|(sum, value)| *sum += value * value / count);
    }
    // Plus one unit, so that a nearly constant feature gets no large weight.
    deviation.iter_mut().for_each(|value| *value = value.sqrt() + 1.0);
    (middle, deviation)
}

/// Standardised and limited features, in a row that ends with 1.
fn standardise(features: &Features, middle: &[f64], deviation: &[f64], row: &mut [f64]) {
    let standard = middle.iter().zip(deviation);
    for ((place, value), (middle, deviation)) in row.iter_mut().zip(features).zip(standard) {
        *place = ((f64::from(*value) - middle) / deviation).clamp(-FARTHEST, FARTHEST);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_apart_are_distinguished() {
        let of = |shift: u16| -> Vec<Features> {
            (0..40u16)
                .map(|i| {
                    std::array::from_fn(|f| {
                        1000 + (i * 37 + f as u16 * 11) % 300 + if f == 5 { shift } else { 0 }
                    })
                })
                .collect()
        };
        let (low, high) = (of(0), of(900));
        let examples: Vec<_> = low.iter().map(|f| (f, 0)).chain(high.iter().map(|f| (f, 1))).collect();
        let ridge = Ridge::fit(&examples, 2, 1.0, 0.5);
        let heaviest =
            (0..FEATURES).max_by(|a, b| ridge.weights[1][*a].abs().total_cmp(&ridge.weights[1][*b].abs()));
        assert!(heaviest == Some(5) && ridge.weights[1][5] > 0.0);
    }
}
