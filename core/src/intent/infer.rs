//! Inference: the map applied to its own output until it settles.
//!
//! | | |
//! |---|---|
//! | input | `[i32; N]`, 1.0 = `map.one()`, clamped to -1 ..= 1 |
//! | output | the same unit |
//! | saturation | none inside: `build` proves that every sum fits 32 bits |
//! | error | one step: sigmoid 0.8, tanh 1.1 steps of 2^-15, thresholds none; settled, the shipped map: 4e-4 |
//! | latency | within the call |
//! | RAM | 3 states of 4 N bytes on the stack, written only for the concepts that the map has |
//! | M0+ cycles | a step 400, 100 for a free concept, 12 for each of its causes; the shipped map 2,000 |
//!
//! The parts of a step are read off the disassembly, not measured. The shipped map settles within six steps.

use super::config::Rule;
use super::map::Map;
use super::transfer::{Transfer, sigmoid_of_twice, tanh};
use heapless::Vec;

/// Greatest extent of a cycle of a smooth map that counts as a fixed point, in units of 2^-15: 4.9e-4.
/// Rounding to Q15 is noise of half a unit at every step, which a map that settles slowly amplifies; fcmpy8
/// of the reference set (kosko, tanh, lambda 1) ends in a cycle of period 24 within 8 units of its fixed
/// point.
pub const ROUNDING: i32 = 16;

/// End of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Outcome {
    /// The state reproduces itself. For smooth maps this includes a cycle that stays within [`ROUNDING`] of
    /// the state where it was noticed: a fixed point that rounding does not let come to rest. Its steps are
    /// below the resolution of 2^-15. This need not mean that the limit is near: a map that creeps towards it
    /// ever more slowly stops on the way (1.2e-2 from the exact state after as many steps, and 0.22 from that
    /// after 100,000, in one of the 48 smooth reference trajectories).
    Fixed,
    /// The state returns after this many steps, and not earlier; at least 2.
    Cycle(u16),
    /// Neither was found within the allowed steps.
    Unsettled,
}

/// The result of an inference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inference<const N: usize> {
    /// The last state, in units of 1 / `map.one()`.
    pub state: [i32; N],
    /// Steps taken. For a fixed point the last of them changed nothing: state 3 = state 4 are 4 steps.
    pub steps: u16,
    /// End of the trajectory.
    pub outcome: Outcome,
}

impl<const N: usize, const E: usize> Map<N, E> {
    /// Runs the map from `start` (the first of the N + 1 states of a trajectory) for at most `steps` steps,
    /// and stops where it settles. Bounded, and never panics: memory does not depend on `steps`; with 0 steps
    /// the outcome is unsettled.
    ///
    /// Cycles are found by Brent's algorithm: one remembered state, moved ahead at every power of two. The
    /// period is exact; a cycle is noticed after at most three times the steps it took to enter it and to run
    /// through it once.
    pub fn infer(&self, start: &[i32; N], steps: u16) -> Inference<N> {
        let mut run = Inference { state: [0; N], steps, outcome: Outcome::Unsettled };
        self.infer_into(start, steps, &mut run);
        run
    }

    /// Runs like [`Map::infer`], in place of an earlier result. `start` has a value for each concept of the
    /// map; the rest of the state stays as it was.
    pub fn infer_into(&self, start: &[i32], steps: u16, run: &mut Inference<N>) {
        // Lists instead of arrays: they need not be filled with zeros, so a small map does not cost as much
        // as a large one.
        let (mut next, mut mark) = (Vec::new(), Vec::new());
        self.clamp(start, &mut run.state);
        (run.steps, run.outcome) = (steps, Outcome::Unsettled);
        self.keep(&run.state, &mut mark);
        let (mut since, mut reach, mut extent) = (0u16, 1u16, 0i32);
        for taken in 1..=steps {
            self.advance(&run.state, &mut next);
            let rests = next.iter().zip(&run.state).all(|(to, from)| to == from);
            let distance = distance(&next, &mark);
            run.state.iter_mut().zip(&next).for_each(|(to, from)| *to = *from);
            since = since.saturating_add(1);
            extent = extent.max(distance);
            if rests || distance == 0 {
                let rounding = extent <= ROUNDING && !self.transfer.is_threshold();
                let fixed = rests || rounding;
                run.outcome = if fixed { Outcome::Fixed } else { Outcome::Cycle(since) };
                run.steps = taken;
                return;
            }
            if since == reach {
                self.keep(&run.state, &mut mark);
                (since, extent) = (0, 0);
                reach = reach.saturating_mul(2);
            }
        }
    }

    /// Returns the state after one step from any state; values beyond -1 ..= 1 are clamped first. Never
    /// panics.
    pub fn step(&self, state: &[i32; N]) -> [i32; N] {
        let (mut out, mut next) = ([0; N], Vec::new());
        self.clamp(state, &mut out);
        self.advance(&out, &mut next);
        out.iter_mut().zip(&next).for_each(|(to, from)| *to = *from);
        out
    }

    /// Computes one step from a state within -1 ..= 1, for which `build` proved that the sums fit. `next`
    /// gets one value per concept.
    fn advance(&self, state: &[i32; N], next: &mut Vec<i32, N>) {
        let rescaled = self.rule == Rule::Rescaled;
        let own = if self.rule == Rule::Kosko { 0 } else { self.step };
        let y = |x: i32| if rescaled { 2 * x - self.one } else { x };
        let mut causes = self.causes.iter();
        next.clear();
        for (row, x) in self.rows.iter().zip(state) {
            if row.held {
                let _ = next.push(*x); // it has no causes
                continue;
            }
            let mut sum = row.bias + ((own * y(*x)) >> self.shift);
            for cause in causes.by_ref().take(row.causes.into()) {
                // `build` proved that the cause exists.
                let x = state.get(usize::from(cause.from)).copied().unwrap_or(0);
                sum += (i32::from(cause.weight) * y(x)) >> self.shift;
            }
            // Always room: one value per row.
            let _ = next.push(self.transferred(sum));
        }
    }

    fn transferred(&self, sum: i32) -> i32 {
        match self.transfer {
            Transfer::Bivalent => i32::from(sum > 0) * self.one,
            Transfer::Trivalent => sum.signum() * self.one,
            Transfer::Sigmoid => sigmoid_of_twice(self.gain.apply(sum)),
            Transfer::Tanh => tanh(self.gain.apply(sum)),
            Transfer::Positive => tanh(self.gain.apply(sum.max(0))),
        }
    }

    /// Clamps the concepts of the map to -1 ..= 1.
    fn clamp(&self, state: &[i32], out: &mut [i32; N]) {
        for (to, from) in out.iter_mut().zip(state).take(self.concepts.len()) {
            // `clamp` of integers would panic on an empty range, which the compiler cannot exclude.
            *to = (*from).max(-self.one).min(self.one);
        }
    }

    /// Copies the concepts of the map.
    fn keep(&self, state: &[i32; N], to: &mut Vec<i32, N>) {
        to.clear();
        state.iter().take(self.concepts.len()).for_each(|value| _ = to.push(*value));
    }
}

/// Greatest difference between two concepts of the same index.
fn distance(a: &[i32], b: &[i32]) -> i32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).max().unwrap_or(0)
}
