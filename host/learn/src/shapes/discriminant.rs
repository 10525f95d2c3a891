//! Linear discriminant analysis: finds the directions that separate classes.

use crate::linear::{Square, back, forward};

/// A projection `weights (x - origin)`; within a class, each output has a spread of 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Discriminant {
    /// The mean of the examples.
    pub origin: Vec<f64>,
    /// A row for each dimension, the most discriminating first.
    pub weights: Vec<Vec<f64>>,
}

impl Discriminant {
    /// Analyses examples with their classes (`0 .. classes`). The scatter within classes is shrunk towards a
    /// multiple of the identity matrix by `shrinkage` (0 to 1), in measures scaled to equal spread, because
    /// few examples give a poor estimate of it.
    pub fn of(
        rows: &[Vec<f64>],
        labels: &[usize],
        classes: usize,
        dimensions: usize,
        shrinkage: f64,
    ) -> Discriminant {
        let measures = rows.first().map_or(0, Vec::len);
        let count = rows.len() as f64;
        let mean = |member: &dyn Fn(usize) -> bool| {
            let chosen: Vec<&Vec<f64>> =
                rows.iter().zip(labels).filter(|(_, label)| member(**label)).map(|(row, _)| row).collect();
            let mean = (0..measures)
                .map(|i| chosen.iter().map(|row| row[i]).sum::<f64>() / chosen.len().max(1) as f64);
            (mean.collect::<Vec<f64>>(), chosen.len() as f64)
        };
        let (origin, _) = mean(&|_| true);
        let means: Vec<(Vec<f64>, f64)> = (0..classes).map(|class| mean(&|label| label == class)).collect();
        let spread =
            |i: usize| (rows.iter().map(|row| (row[i] - origin[i]).powi(2)).sum::<f64>() / count).sqrt();
        let scale: Vec<f64> = (0..measures).map(|i| 1.0 / spread(i).max(1e-9)).collect();
        let apart =
            |a: &[f64], b: &[f64]| -> Vec<f64> { (0..measures).map(|i| (a[i] - b[i]) * scale[i]).collect() };
        let mut within = Square::zero(measures);
        for (row, label) in rows.iter().zip(labels) {
            within.add_outer(&apart(row, &means[*label].0), 1.0 / count);
        }
        let mut between = Square::zero(measures);
        for (mean, members) in &means {
            between.add_outer(&apart(mean, &origin), members / count);
        }
        let trace: f64 = (0..measures).map(|i| within.row(i)[i]).sum::<f64>() / measures.max(1) as f64;
        within.cells.iter_mut().for_each(|cell| *cell *= 1.0 - shrinkage);
        (0..measures).for_each(|i| *within.at(i, i) += (shrinkage * trace).max(1e-9));
        let lower = within.cholesky();
        // L^-1 B L^-T: columns, then rows.
        let half: Vec<Vec<f64>> = (0..measures).map(|i| forward(&lower, between.row(i))).collect();
        let mut whitened = Square::zero(measures);
        for j in 0..measures {
            let column: Vec<f64> = half.iter().map(|row| row[j]).collect();
            forward(&lower, &column).into_iter().enumerate().for_each(|(i, cell)| *whitened.at(i, j) = cell);
        }
        let axes = whitened.eigen().into_iter().take(dimensions.min(classes - 1).min(measures));
        let weights =
            axes.map(|(_, axis)| back(&lower, &axis).iter().zip(&scale).map(|(a, b)| a * b).collect());
        Discriminant { origin, weights: weights.collect() }
    }

    /// Projects a row.
    pub fn place(&self, row: &[f64]) -> Vec<f64> {
        let axis = |weights: &Vec<f64>| {
            weights.iter().zip(row.iter().zip(&self.origin)).map(|(w, (x, o))| w * (x - o)).sum()
        };
        self.weights.iter().map(axis).collect()
    }
}
