//! Descent of a map's weights, one weight at a time.
//!
//! A weight is moved up or down by each size of move wherever that lowers the loss (plus the cost of leaving the
//! weights with which the map began), in the order of the map, until no move helps. No weight changes its sign or
//! becomes 0, no edge is added, and `fixed` weights stay. Weights are hundredths.

use super::map::MapFile;
use super::weight::Weight;

/// Most rounds over all weights with one size of move.
const ROUNDS: usize = 20;

/// How a map's weights are searched.
#[derive(Debug, Clone)]
pub struct Descent {
    /// Sizes of moves, in hundredths, in their order.
    pub moves: &'static [i64],
    /// Loss per unit of movement over all weights, so that useless moves are not made.
    pub pull: f64,
}

impl Descent {
    /// Returns the map with the weights of the edges for whose numbers `is_free` is true moved towards the least
    /// `loss`, which is called once for each weight tried.
    pub fn run<E>(
        &self,
        file: &MapFile,
        is_free: impl Fn(usize) -> bool,
        mut loss: impl FnMut(&MapFile) -> Result<f64, E>,
    ) -> Result<MapFile, E> {
        let begun: Vec<i64> = file.edge.iter().map(|edge| hundredths(&edge.weight)).collect();
        let may_move = |at: &usize| !file.edge[*at].fixed && begun[*at] != 0 && is_free(*at);
        let free: Vec<usize> = (0..begun.len()).filter(may_move).collect();
        let mut cost = |weights: &[i64]| -> Result<f64, E> {
            let moved: i64 = weights.iter().zip(&begun).map(|(now, before)| (now - before).abs()).sum();
            Ok(loss(&with(file, weights))? + self.pull * moved as f64 / 100.0)
        };
        let mut now = begun.clone();
        let mut least = cost(&now)?;
        for size in self.moves {
            for _ in 0..ROUNDS {
                let before = least;
                for at in &free {
                    let sign = begun[*at].signum();
                    for moved in [now[*at] + size, now[*at] - size] {
                        let kept = std::mem::replace(&mut now[*at], sign * (sign * moved).clamp(1, 100));
                        let loss = if now[*at] == kept { least } else { cost(&now)? };
                        if loss < least {
                            least = loss;
                            break;
                        }
                        now[*at] = kept;
                    }
                }
                if least >= before {
                    break;
                }
            }
        }
        Ok(with(file, &now))
    }
}

fn hundredths(weight: &Weight) -> i64 {
    (weight.value() * 100.0).round() as i64
}

/// The map with weights in hundredths; unchanged ones keep their notation.
fn with(file: &MapFile, weights: &[i64]) -> MapFile {
    let mut map = file.clone();
    for (edge, weight) in map.edge.iter_mut().zip(weights) {
        if hundredths(&edge.weight) != *weight {
            edge.weight = Weight::Number(*weight as f64 / 100.0);
        }
    }
    map
}
