//! Linear algebra for training: symmetric matrices, stored by rows.

/// A square matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Square {
    /// Number of rows.
    pub n: usize,
    /// n x n values.
    pub cells: Vec<f64>,
}

impl Square {
    /// The zero matrix.
    pub fn zero(n: usize) -> Square {
        Square { n, cells: vec![0.0; n * n] }
    }

    /// Row `i`.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.cells[i * self.n..][..self.n]
    }

    /// Mutable row `i`.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.cells[i * self.n..][..self.n]
    }

    /// The cell at row `i` and column `j`.
    pub fn at(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.cells[i * self.n + j]
    }

    /// Adds `weight v v^T`.
    pub fn add_outer(&mut self, v: &[f64], weight: f64) {
        for (row, a) in self.cells.chunks_mut(self.n).zip(v) {
            row.iter_mut().zip(v).for_each(|(cell, b)| *cell += weight * a * b);
        }
    }

    /// Lower triangle L with L L^T = self, for a positive definite matrix; only the lower half is read.
    pub fn cholesky(&self) -> Square {
        let mut lower = Square::zero(self.n);
        for i in 0..self.n {
            for j in 0..=i {
                let sum: f64 = lower.row(i)[..j].iter().zip(&lower.row(j)[..j]).map(|(a, b)| a * b).sum();
                let rest = self.row(i)[j] - sum;
                *lower.at(i, j) = if i == j { rest.max(1e-12).sqrt() } else { rest / lower.row(j)[j] };
            }
        }
        lower
    }

    /// Eigenvalues and eigenvectors of a symmetric matrix, largest first, by Jacobi rotations.
    pub fn eigen(mut self) -> Vec<(f64, Vec<f64>)> {
        let n = self.n;
        let mut vectors = Square::zero(n);
        (0..n).for_each(|i| *vectors.at(i, i) = 1.0);
        for _ in 0..30 {
            let off: f64 =
                (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| self.row(i)[j].powi(2)).sum();
            let all: f64 = self.cells.iter().map(|cell| cell * cell).sum();
            if off <= all * 1e-24 {
                break;
            }
            for p in 0..n {
                for q in p + 1..n {
                    self.rotate(&mut vectors, p, q);
                }
            }
        }
        let vector = |i: usize| (0..n).map(|row| vectors.row(row)[i]).collect();
        let mut pairs: Vec<(f64, Vec<f64>)> = (0..n).map(|i| (self.row(i)[i], vector(i))).collect();
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        pairs
    }

    /// One rotation that zeroes the cells (p, q) and (q, p).
    fn rotate(&mut self, vectors: &mut Square, p: usize, q: usize) {
        let apq = self.row(p)[q];
        if apq == 0.0 {
            return;
        }
        let theta = (self.row(q)[q] - self.row(p)[p]) / (2.0 * apq);
        let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let c = 1.0 / t.hypot(1.0);
        let s = t * c;
        for k in 0..self.n {
            let (a, b) = (self.row(k)[p], self.row(k)[q]);
            (*self.at(k, p), *self.at(k, q)) = (c * a - s * b, s * a + c * b);
            let (a, b) = (vectors.row(k)[p], vectors.row(k)[q]);
            (*vectors.at(k, p), *vectors.at(k, q)) = (c * a - s * b, s * a + c * b);
        }
        for k in 0..self.n {
            let (a, b) = (self.row(p)[k], self.row(q)[k]);
            (*self.at(p, k), *self.at(q, k)) = (c * a - s * b, s * a + c * b);
        }
    }
}

/// Solves `L^T x = b` for a lower triangle.
pub fn back(lower: &Square, b: &[f64]) -> Vec<f64> {
    let mut x = b.to_vec();
    for i in (0..lower.n).rev() {
        x[i] /= lower.row(i)[i];
        let known = x[i];
        (0..i).for_each(|j| x[j] -= lower.row(i)[j] * known);
    }
    x
}

/// Solves `L x = b` for a lower triangle.
pub fn forward(lower: &Square, b: &[f64]) -> Vec<f64> {
    let mut x = b.to_vec();
    for i in 0..lower.n {
        let sum: f64 = lower.row(i)[..i].iter().zip(&x[..i]).map(|(a, b)| a * b).sum();
        x[i] = (x[i] - sum) / lower.row(i)[i];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(n: usize, seed: u64) -> Square {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut matrix = Square::zero(n);
        for _ in 0..2 * n {
            let v: Vec<f64> = (0..n).map(|_| random.f64() - 0.5).collect();
            matrix.add_outer(&v, 1.0);
        }
        matrix
    }

    fn times(matrix: &Square, v: &[f64]) -> Vec<f64> {
        (0..matrix.n).map(|i| matrix.row(i).iter().zip(v).map(|(a, b)| a * b).sum()).collect()
    }

    #[test]
    fn eigenvectors_are_what_the_matrix_stretches() {
        for n in [1, 2, 5, 24] {
            let matrix = random(n, n as u64);
            let pairs = matrix.clone().eigen();
            for (value, vector) in &pairs {
                let length: f64 = vector.iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-9);
                for (have, want) in times(&matrix, vector).iter().zip(vector) {
                    assert!((have - value * want).abs() < 1e-9);
                }
            }
            assert!(pairs.windows(2).all(|pair| pair[0].0 >= pair[1].0));
        }
    }

    #[test]
    fn triangles_solve_what_they_are_of() {
        let matrix = random(9, 1);
        let lower = matrix.cholesky();
        let b: Vec<f64> = (0..9).map(f64::from).collect();
        let x = back(&lower, &forward(&lower, &b));
        for (have, want) in times(&matrix, &x).iter().zip(&b) {
            assert!((have - want).abs() < 1e-8);
        }
    }
}
