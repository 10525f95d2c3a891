//! Confidence of decisions: the share of right ones by lead and age, fitted to predictions of left-out
//! touches.

use crate::linear::{Square, back, forward};
use taxel_core::gesture::LEADS;

/// A decision about a left-out touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// Lead of the class over the second, in score.
    pub lead: f64,
    /// Frames observed.
    pub frames: usize,
    /// True if it was right.
    pub right: bool,
}

/// Logarithm of the odds as a function of the lead and of the logarithm of the age: constant, lead, age, lead
/// times age.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConfidenceFit([f64; 4]);

/// Prior towards even odds, with the weight of this many touches.
const PENALTY: f64 = 1.0;

/// Steps of Newton's method; it converges within ten.
const STEPS: usize = 25;

impl ConfidenceFit {
    /// Penalised maximum-likelihood fit to the decisions.
    pub fn fit(judged: &[Judged]) -> ConfidenceFit {
        let mut weights = [0.0; 4];
        for _ in 0..STEPS {
            let mut slope = weights.map(|w| -PENALTY * w).to_vec();
            let mut bend = Square::zero(4);
            (0..4).for_each(|i| *bend.at(i, i) = PENALTY);
            for decision in judged {
                let row = terms(decision.lead, decision.frames);
                let expected = logistic(dot(&weights, &row));
                let error = if decision.right { 1.0 } else { 0.0 } - expected;
                slope.iter_mut().zip(row).for_each(|(sum, term)| *sum += error * term);
                bend.add_outer(&row, expected * (1.0 - expected));
            }
            let lower = bend.cholesky();
            let step = back(&lower, &forward(&lower, &slope));
            weights.iter_mut().zip(step).for_each(|(weight, step)| *weight += step);
        }
        ConfidenceFit(weights)
    }

    /// Share of right decisions at each lead of a row; non-decreasing in the lead.
    pub fn row(&self, frames: usize) -> [f64; LEADS] {
        let mut row = std::array::from_fn(|knot| {
            logistic(dot(&self.0, &terms(knot as f64 * 2.0 / (LEADS - 1) as f64, frames)))
        });
        (1..LEADS).for_each(|knot| row[knot] = row[knot].max(row[knot - 1]));
        row
    }
}

fn terms(lead: f64, frames: usize) -> [f64; 4] {
    let (lead, age) = (lead.min(2.0), (frames.max(1) as f64).log2());
    [1.0, lead, age, lead * age]
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_finds_the_odds_by_which_the_decisions_were_drawn() {
        let truth = ConfidenceFit([-1.0, 1.5, 0.2, 0.1]);
        let mut random = fastrand::Rng::with_seed(7);
        let judged: Vec<Judged> = (0..20_000)
            .map(|_| {
                let (lead, frames) = (2.0 * random.f64(), random.usize(1..200));
                let right = random.f64() < logistic(dot(&truth.0, &terms(lead, frames)));
                Judged { lead, frames, right }
            })
            .collect();
        let fitted = ConfidenceFit::fit(&judged);
        for frames in [2, 30, 150] {
            for (have, want) in fitted.row(frames).into_iter().zip(truth.row(frames)) {
                assert!((have - want).abs() < 0.03, "{frames} frames: {have:.3} of {want:.3}");
            }
        }
    }

    #[test]
    fn a_greater_lead_is_never_less_sure() {
        // Right decisions become rarer with the lead: such a random result must not be believed.
        let judged: Vec<Judged> =
            (0..100).map(|n| Judged { lead: f64::from(n) / 50.0, frames: 9, right: n < 30 }).collect();
        let row = ConfidenceFit::fit(&judged).row(9);
        assert!(row.is_sorted(), "{row:?}");
    }
}
