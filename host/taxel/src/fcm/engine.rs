//! Inference on the host: an f64 engine, an exact one for threshold maps, and the core's arithmetic for
//! comparison.
//!
//! The f64 and the exact engine share no code with the core, because they are its reference.

use super::decimal::Decimal;
use crate::error::{MapFileError, Result};
use std::collections::HashMap;
use taxel_core::format::name;
use taxel_core::intent::infer::ROUNDING;
use taxel_core::intent::{Edge, Map, MapConfig, Outcome, Rule, Threshold, Transfer};

/// Most concepts for which the core's arithmetic is run on the host.
pub const Q15_CONCEPTS: usize = 128;
/// Every pair of them may have an edge.
pub(crate) const Q15_EDGES: usize = Q15_CONCEPTS * Q15_CONCEPTS;

/// A map and its initial state, as read from a file: all numbers decimal, in -1 ..= 1.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Problem {
    /// Names of the concepts.
    pub names: Vec<String>,
    /// `weights[i][j]` is the causality value of the edge i -> j.
    pub weights: Vec<Vec<Decimal>>,
    /// Initial state.
    pub start: Vec<Decimal>,
    /// Thresholds of single concepts, instead of the common one; may be shorter than the list of concepts.
    pub thresholds: Vec<Option<Decimal>>,
}

impl Problem {
    /// Threshold of a concept.
    fn threshold(&self, settings: &Settings, concept: usize) -> Decimal {
        self.thresholds.get(concept).copied().flatten().unwrap_or(settings.threshold)
    }
}

/// Settings of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Rule of the sum.
    pub rule: Rule,
    /// Transfer function of the sum.
    pub transfer: Transfer,
    /// Steepness of the smooth transfer functions.
    pub lambda: f64,
    /// Threshold of every concept.
    pub threshold: Decimal,
    /// True if concepts without an incoming edge keep their value.
    pub held: bool,
}

impl Default for Settings {
    /// Defaults: kosko, tanh, lambda 1, threshold 0, inputs held.
    fn default() -> Settings {
        let (rule, transfer) = (Rule::Kosko, Transfer::Tanh);
        Settings { rule, transfer, lambda: 1.0, threshold: Decimal::default(), held: true }
    }
}

/// Sequence of states, and its outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// Initial state, and one for each requested step, also after the map has settled.
    pub states: Vec<Vec<f64>>,
    /// Steps until a state was repeated; all steps if none was.
    pub steps: usize,
    /// Outcome; a period that exceeds 16 bits is given as 65,535.
    pub outcome: Outcome,
}

impl Trajectory {
    /// The last state.
    pub fn last(&self) -> &[f64] {
        self.states.last().map_or(&[], Vec::as_slice)
    }

    /// Judges states: fixed if no value moves by more than `still`, or if a cycle's values move by at most
    /// `wobble` (rounding around a fixed point).
    fn judged(states: Vec<Vec<f64>>, still: f64, wobble: f64) -> Trajectory {
        let mut seen = HashMap::new();
        for (at, state) in states.iter().enumerate() {
            if at > 0 && apart(state, &states[at - 1]) <= still {
                return Trajectory { states, steps: at, outcome: Outcome::Fixed };
            }
            // + 0.0 turns -0.0 into 0.0.
            let key: Vec<u64> = state.iter().map(|v| (v + 0.0).to_bits()).collect();
            if let Some(first) = seen.insert(key, at) {
                let small = states[first..at].iter().all(|other| apart(other, state) <= wobble);
                let period = u16::try_from(at - first).unwrap_or(u16::MAX);
                let outcome = if small { Outcome::Fixed } else { Outcome::Cycle(period) };
                return Trajectory { states, steps: at, outcome };
            }
        }
        let steps = states.len() - 1;
        Trajectory { states, steps, outcome: Outcome::Unsettled }
    }
}

/// Largest difference between two states.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Runs `steps` steps: in f64 for the smooth transfer functions, in exact decimal integers for the others.
pub fn run(problem: &Problem, settings: &Settings, steps: usize) -> Trajectory {
    if settings.transfer.is_threshold() {
        exact(problem, settings, steps)
    } else {
        float(problem, settings, steps)
    }
}

/// True if concept `j` keeps its value.
fn keeps(problem: &Problem, settings: &Settings, j: usize) -> bool {
    settings.held && problem.weights.iter().all(|row| row[j].digits == 0)
}

fn float(problem: &Problem, settings: &Settings, steps: usize) -> Trajectory {
    let weights: Vec<Vec<f64>> =
        problem.weights.iter().map(|row| row.iter().map(|w| w.to_f64()).collect()).collect();
    let thresholds: Vec<f64> =
        (0..problem.names.len()).map(|j| problem.threshold(settings, j).to_f64()).collect();
    let mut states: Vec<Vec<f64>> = vec![problem.start.iter().map(|v| v.to_f64()).collect()];
    for _ in 0..steps {
        let x = &states[states.len() - 1];
        let y: Vec<f64> =
            x.iter().map(|x| if settings.rule == Rule::Rescaled { 2.0 * x - 1.0 } else { *x }).collect();
        let next = (0..x.len()).map(|j| {
            if keeps(problem, settings, j) {
                return x[j];
            }
            let own = if settings.rule == Rule::Kosko { 0.0 } else { y[j] };
            let z = weights.iter().zip(&y).map(|(row, y)| row[j] * y).sum::<f64>() + own - thresholds[j];
            match settings.transfer {
                Transfer::Sigmoid => 1.0 / (1.0 + (-settings.lambda * z).exp()),
                Transfer::Positive => (settings.lambda * z.max(0.0)).tanh(),
                _ => (settings.lambda * z).tanh(),
            }
        });
        let next = next.collect();
        states.push(next);
    }
    // A change by one rounding of 1.0 counts as none; a cycle of a few of them is a fixed point.
    Trajectory::judged(states, f64::EPSILON, 1e-12)
}

fn exact(problem: &Problem, settings: &Settings, steps: usize) -> Trajectory {
    let decimals = problem.weights.iter().flatten().chain(&problem.start).map(|d| d.decimals);
    let thresholds = (0..problem.names.len()).map(|j| problem.threshold(settings, j));
    let decimals = decimals.chain(thresholds.clone().map(|t| t.decimals)).max().unwrap_or(0);
    let one = 10i128.pow(decimals);
    let weights: Vec<Vec<i128>> =
        problem.weights.iter().map(|row| row.iter().map(|w| w.scaled(one)).collect()).collect();
    let thresholds: Vec<i128> = thresholds.map(|t| t.scaled(one) * one).collect();
    let mut state: Vec<i128> = problem.start.iter().map(|v| v.scaled(one)).collect();
    let as_float = |state: &[i128]| state.iter().map(|v| Decimal { digits: *v, decimals }.to_f64()).collect();
    let mut states: Vec<Vec<f64>> = vec![as_float(&state)];
    for _ in 0..steps {
        let y: Vec<i128> =
            state.iter().map(|x| if settings.rule == Rule::Rescaled { 2 * x - one } else { *x }).collect();
        let next = (0..state.len()).map(|j| {
            if keeps(problem, settings, j) {
                return state[j];
            }
            let own = if settings.rule == Rule::Kosko { 0 } else { y[j] * one };
            let z = weights.iter().zip(&y).map(|(row, y)| row[j] * y).sum::<i128>() + own - thresholds[j];
            let level = z.signum() * one;
            if settings.transfer == Transfer::Bivalent { level.max(0) } else { level }
        });
        state = next.collect();
        states.push(as_float(&state));
    }
    Trajectory::judged(states, 0.0, 0.0)
}

/// Runs `steps` steps of the core. Weights with more than four decimals are rounded to four.
pub fn q15(problem: &Problem, settings: &Settings, steps: usize) -> Result<Trajectory> {
    let map = core_map(problem, settings)?;
    let mut state = [0i32; Q15_CONCEPTS];
    for (out, value) in state.iter_mut().zip(&problem.start) {
        *out = value.scaled(map.one().into()) as i32;
    }
    let as_float =
        |state: &[i32]| state[..map.len()].iter().map(|v| f64::from(*v) / f64::from(map.one())).collect();
    let mut states: Vec<Vec<f64>> = vec![as_float(&state)];
    for _ in 0..steps {
        state = map.step(&state);
        states.push(as_float(&state));
    }
    let wobble =
        if settings.transfer.is_threshold() { 0.0 } else { f64::from(ROUNDING) / f64::from(map.one()) };
    Ok(Trajectory::judged(states, 0.0, wobble))
}

/// Builds the core's map.
pub fn core_map(problem: &Problem, settings: &Settings) -> Result<Box<Map<Q15_CONCEPTS, Q15_EDGES>>> {
    if problem.names.len() > Q15_CONCEPTS {
        fail!(
            MapFileError::TooLarge,
            "{} concepts: the core's arithmetic is run for up to {Q15_CONCEPTS}",
            problem.names.len()
        );
    }
    let own = problem.thresholds.iter().flatten();
    let numbers = problem.weights.iter().flatten().chain(own).chain([&settings.threshold]);
    let start = problem.start.iter().filter(|_| settings.transfer.is_threshold());
    let decimals = numbers.chain(start).map(|d| d.decimals).max().unwrap_or(0).min(4);
    let step = 10i128.pow(decimals);
    let lambda = (settings.lambda * 1000.0).round();
    if settings.lambda > 65.535 {
        fail!(
            MapFileError::TooLarge,
            "lambda = {} is above 65.535, the largest of the core",
            settings.lambda
        );
    }
    let mut config: Box<MapConfig<Q15_CONCEPTS, Q15_EDGES>> = Box::default();
    let too_many = |what: &str| error!(MapFileError::TooLarge, "too many {what}");
    config.decimals = decimals as u8;
    (config.rule, config.transfer, config.held) = (settings.rule, settings.transfer, settings.held);
    (config.lambda, config.threshold) = (lambda as u16, settings.threshold.scaled(step) as i16);
    for index in 0..problem.names.len() {
        // Index instead of name: long names may be equal after truncation, and the core only needs them to
        // differ.
        config.concepts.push(name(&index.to_string())).map_err(|_| too_many("concepts"))?;
    }
    for (concept, own) in problem.thresholds.iter().enumerate() {
        if let Some(own) = own {
            let own = Threshold { concept: concept as u8, value: own.scaled(step) as i16 };
            config.thresholds.push(own).map_err(|_| too_many("thresholds"))?;
        }
    }
    for (from, row) in problem.weights.iter().enumerate() {
        for (to, weight) in row.iter().enumerate().filter(|(_, w)| w.digits != 0) {
            let edge = Edge { from: from as u8, to: to as u8, weight: weight.scaled(step) as i16 };
            config.edges.push(edge).map_err(|_| too_many("edges"))?;
        }
    }
    Ok(Box::new(Map::build(&*config)?))
}
