//! How a map behaves over a sweep of its inputs.

use super::board::BoardMap;
use super::decimal::Decimal;
use super::map::MapFile;
use anyhow::Result;
use taxel_core::intent::Outcome;

/// Most starts of a sweep.
pub const STARTS: usize = 4096;
/// Levels of an input, in quarters; a coarser list where there are many inputs.
const LEVELS: [&[i128]; 3] = [&[-4, -3, -2, -1, 0, 1, 2, 3, 4], &[-4, 0, 2, 4], &[-4, 4]];

/// Activations by the name of the concept.
pub type Inputs = Vec<(String, Decimal)>;

/// What a sweep found.
#[derive(Debug, Default, Clone)]
pub struct Sweep {
    /// Inferences that were run.
    pub starts: usize,
    /// The most steps until a map settled.
    pub steps: u16,
    /// Inferences that end in a cycle, and the first of them: its inputs and its period.
    pub cycles: (usize, Option<(Inputs, u16)>),
    /// Inferences that never settled, and the inputs of the first of them.
    pub unsettled: (usize, Option<Inputs>),
}

/// Runs a map from a grid of the activations of its entries (the finest of up to [`STARTS`] points; random
/// ones of the same levels where even two levels are too many).
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
