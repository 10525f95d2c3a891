//! Attributes an activation to inputs and paths, in shares that add up exactly.
//!
//! A concept's sum is the contributions of its causes, by [`Map::why`](taxel_core::intent::Map::why). The
//! contribution of a cause is divided among its own causes in proportion to their contributions to its sum,
//! and so on back to the inputs. Shares are whole units of 2^-15, rounded so that they add up to what is
//! divided. The rest is due to no input: thresholds, the activation of a concept at rest (0.5 with the
//! sigmoid), and rings.

use super::board::{BoardMap, MapState};
use std::collections::BTreeMap;
use taxel_core::intent::{Rule, Transfer, Why};

/// Most paths to follow; what is left then goes to the rest.
const PATHS: usize = 10_000;

/// Contribution of one path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Path {
    /// Concepts from the input to the last cause before the explained concept.
    pub concepts: Vec<usize>,
    /// Contribution in units of 2^-15.
    pub share: i64,
}

/// Division of a sum.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Shares {
    /// Paths, the greatest share first.
    pub paths: Vec<Path>,
    /// Shares due to no input, by reason.
    pub rest: BTreeMap<String, i64>,
}

impl Shares {
    /// Total of all shares.
    pub fn sum(&self) -> i64 {
        self.paths.iter().map(|path| path.share).sum::<i64>() + self.rest.values().sum::<i64>()
    }

    /// Shares by input over all its paths, the greatest first.
    pub fn inputs(&self) -> Vec<(usize, i64)> {
        let mut inputs = BTreeMap::<usize, i64>::new();
        for path in &self.paths {
            *inputs.entry(path.concepts[0]).or_default() += path.share;
        }
        let mut inputs: Vec<_> = inputs.into_iter().collect();
        inputs.sort_by_key(|(_, share)| std::cmp::Reverse(share.abs()));
        inputs
    }
}

/// Divides the sum of a concept in a settled state.
pub fn shares(map: &BoardMap, state: &MapState, why: &Why<{ super::engine::Q15_CONCEPTS }>) -> Shares {
    let mut search = Search { map, state, found: Shares::default(), path: vec![why.concept.into()] };
    for part in &why.parts {
        search.follow(part.from.into(), part.value.0.into());
    }
    search.leave("threshold of", why.concept.into(), -i64::from(why.threshold.0));
    search.found.paths.sort_by_key(|path| std::cmp::Reverse(path.share.abs()));
    search.found
}

struct Search<'a> {
    map: &'a BoardMap,
    state: &'a MapState,
    found: Shares,
    /// Concepts from the explained one backwards.
    path: Vec<usize>,
}

impl Search<'_> {
    /// Divides the contribution of `concept`.
    fn follow(&mut self, concept: usize, share: i64) {
        if share == 0 {
            return;
        }
        if self.path.contains(&concept) {
            return self.leave("rings through", concept, share);
        }
        if self.found.paths.len() >= PATHS {
            return self.leave("further paths from", concept, share);
        }
        let Some(why) = self.map.map.why(self.state, concept) else {
            let concepts = [concept].into_iter().chain(self.path.iter().skip(1).rev().copied()).collect();
            return self.found.paths.push(Path { concepts, share });
        };
        let resting = self.resting(concept, share);
        self.leave("resting level of", concept, resting);
        let (share, sum) = (share - resting, i64::from(why.sum.0));
        if sum == 0 {
            return self.leave("resting level of", concept, share);
        }
        self.path.push(concept);
        let (mut given, mut done) = (0, 0);
        for part in &why.parts {
            done += i64::from(part.value.0);
            let up_to = rounded(share * done, sum);
            self.follow(part.from.into(), up_to - given);
            given = up_to;
        }
        self.path.pop();
        // The parts minus the threshold are the sum, so this is the threshold's share.
        self.leave("threshold of", concept, share - given);
    }

    /// Part of a contribution that the concept would make with a sum of 0.
    fn resting(&self, concept: usize, share: i64) -> i64 {
        let one = i64::from(self.map.map.one());
        let at_rest = if self.map.transfer == Transfer::Sigmoid { one / 2 } else { 0 };
        let y = |x: i64| if self.map.rule == Rule::Rescaled { 2 * x - one } else { x };
        match y(i64::from(self.state[concept])) {
            0 => 0,
            now => rounded(share * y(at_rest), now),
        }
    }

    fn leave(&mut self, reason: &str, concept: usize, share: i64) {
        if share != 0 {
            let name = self.map.map.concepts()[concept].as_str();
            *self.found.rest.entry(format!("{reason} {name}")).or_default() += share;
        }
    }
}

/// Quotient rounded to nearest, halves away from zero.
fn rounded(product: i64, by: i64) -> i64 {
    let (size, unit) = (product.unsigned_abs(), by.unsigned_abs());
    let quotient = ((size + unit / 2) / unit) as i64;
    if (product < 0) == (by < 0) { quotient } else { -quotient }
}
