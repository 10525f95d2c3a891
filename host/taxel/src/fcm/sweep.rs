//! Behaviour of a map over a sweep of its inputs.

use super::board::BoardMap;
use super::decimal::Decimal;
use super::map::MapFile;
use crate::error::Result;
use taxel_core::intent::Outcome;

/// Most initial states of a sweep.
pub(crate) const STARTS: usize = 4096;
/// Levels of an input, in quarters; fewer of them if there are many inputs.
const LEVELS: [&[i128]; 3] = [&[-4, -3, -2, -1, 0, 1, 2, 3, 4], &[-4, 0, 2, 4], &[-4, 4]];

/// Activations by the name of the concept.
pub type Inputs = Vec<(String, Decimal)>;

/// Results of a sweep.
#[derive(Debug, Default, Clone)]
pub struct Sweep {
    /// Number of inferences.
    pub starts: usize,
    /// Most steps until the map settled.
    pub steps: u16,
    /// Number of inferences that end in a cycle; inputs and period of the first.
    pub cycles: (usize, Option<(Inputs, u16)>),
    /// Number of inferences that did not settle; inputs of the first.
    pub unsettled: (usize, Option<Inputs>),
}

/// Runs a map from a grid of activations of its entries: the finest grid of up to `STARTS` points; random
/// points of the coarsest grid if that has more.
pub fn sweep(file: &MapFile) -> Result<Sweep> {
    let map = BoardMap::build(file)?;
    let entries = file.entries();
    let count = |levels: &[i128]| levels.len().checked_pow(entries.len() as u32).filter(|n| *n <= STARTS);
    let grid = LEVELS.iter().find_map(|levels| Some((*levels, count(levels)?)));
    let (levels, starts) = grid.unwrap_or((LEVELS[0], STARTS));
    let mut random = fastrand::Rng::with_seed(1);
    let mut found = Sweep { starts, ..Sweep::default() };
    for start in 0..starts {
        let mut rest = start;
        let activations = entries.iter().map(|name| {
            let level = if grid.is_some() { rest % levels.len() } else { random.usize(..levels.len()) };
            rest /= levels.len();
            (name.to_string(), Decimal { digits: levels[level] * 25, decimals: 2 })
        });
        let activations: Vec<_> = activations.collect();
        let numbered = activations.iter().filter_map(|(name, value)| Some((file.find(name)?, *value)));
        let run = map.infer(&map.state(numbered));
        match run.outcome {
            Outcome::Fixed => found.steps = found.steps.max(run.steps),
            Outcome::Cycle(period) => {
                found.cycles.0 += 1;
                found.cycles.1.get_or_insert((activations, period));
            }
            Outcome::Unsettled => {
                found.unsettled.0 += 1;
                found.unsettled.1.get_or_insert(activations);
            }
        }
    }
    Ok(found)
}
