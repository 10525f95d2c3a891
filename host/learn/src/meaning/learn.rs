//! Learning of the weights by which a map bounds threat and attack.
//!
//! A script is played once with the expert's map, and the measured inputs of every inference are kept. A map is then
//! judged on these alone. A word counts as said while two inferences in a row activate it. The loss of a script is
//! the shortfall of a word that must be said, and the excess of every word that must not, in activation beyond a
//! margin about the level of an announcement, times how sure people are; [`Descent`] lowers the mean loss. What kindness
//! needs is not learned.

use super::author::Author;
use super::heard::{Heard, hear_all};
use super::rule::Rule;
use super::varied::varied;
use anyhow::{Context, Result};
use taxel::fcm::board::{BoardMap, MapState};
use taxel::fcm::descent::Descent;
use taxel::fcm::engine::Q15_CONCEPTS;
use taxel::fcm::map::MapFile;
use taxel::sim::Script;
use taxel_core::intent::Leading;

/// Activation from which an intention may lead, as in a scene.
const LEVEL: f64 = 0.5;
/// Activation beyond the level that is asked for.
const MARGIN: f64 = 0.2;
/// The search.
const DESCENT: Descent = Descent { moves: &[10, 5, 2, 1], pull: 0.01 };
/// Effects whose causes are learned.
const LEARNED: [&str; 4] = ["sting", "grip", "threat", "attack"];

/// A script that was played: the inputs of its inferences, and its rule.
pub struct PlayedScript {
    /// Index of the author.
    pub author: usize,
    states: Vec<MapState>,
    must: Vec<Leading>,
    never: Vec<Leading>,
    sure: f64,
}

/// Plays all scripts as they are, and as many variants of each.
pub fn examples(authors: &[Author], file: &MapFile, variants: u64) -> Result<Vec<PlayedScript>> {
    let mut played: Vec<(usize, &Rule, Script)> = Vec::new();
    for (author, judged) in
        authors.iter().enumerate().flat_map(|(at, author)| author.scripts.iter().map(move |it| (at, it)))
    {
        played.push((author, &judged.rule, judged.script.clone()));
        played.extend((1..=variants).map(|seed| (author, &judged.rule, varied(&judged.script, seed))));
    }
    let scripts: Vec<Script> = played.iter().map(|(.., script)| script.clone()).collect();
    let heard = hear_all(&scripts, None)?;
    Ok(played
        .into_iter()
        .zip(heard)
        .map(|((author, rule, _), heard)| example(author, rule, &heard, file))
        .collect())
}

fn example(author: usize, rule: &Rule, heard: &Heard, file: &MapFile) -> PlayedScript {
    let measured: Vec<usize> =
        (0..file.concept.len()).filter(|at| !file.is_driven(&file.concept[*at].name)).collect();
    let state = |activations: &Vec<taxel_core::format::Q15>| {
        let mut state = [0; Q15_CONCEPTS];
        measured.iter().for_each(|at| state[*at] = activations.get(*at).map_or(0, |value| value.0));
        state
    };
    let forbidden = |word: &Leading| {
        rule.nothing || rule.never.contains(word) || !rule.only.is_empty() && !rule.only.contains(word)
    };
    let hostile = [Leading::Threat, Leading::Attack];
    PlayedScript {
        author,
        states: heard.activations.iter().map(|(_, activations)| state(activations)).collect(),
        must: rule.must.iter().copied().filter(|word| hostile.contains(word)).collect(),
        never: hostile.into_iter().filter(forbidden).collect(),
        sure: rule.sure,
    }
}

/// Searches for weights on the examples of all authors but one, or of all.
pub fn learn(file: &MapFile, examples: &[PlayedScript], left_out: Option<usize>) -> Result<MapFile> {
    let taken: Vec<&PlayedScript> = examples.iter().filter(|it| Some(it.author) != left_out).collect();
    let is_learned = |at: usize| LEARNED.contains(&file.edge[at].to.as_str());
    DESCENT.run(file, is_learned, |map| loss(map, &taken))
}

/// Mean loss of a map.
fn loss(file: &MapFile, examples: &[&PlayedScript]) -> Result<f64> {
    let map = BoardMap::build(file)?;
    let find =
        |word: Leading| file.find(word.as_str()).with_context(|| format!("the map lacks {}", word.as_str()));
    let concepts = [find(Leading::Threat)?, find(Leading::Attack)?];
    let of_one = |example: &&PlayedScript| {
        let activations = example.states.iter().map(|state| {
            let run = map.infer(state);
            concepts.map(|at| map.value(run.state[at]))
        });
        let activations: Vec<[f64; 2]> = activations.collect();
        let most = |word: Leading| {
            let at = usize::from(word == Leading::Attack);
            activations.windows(2).map(|two| two[0][at].min(two[1][at])).fold(0.0, f64::max)
        };
        let short = example.must.iter().map(|word| (LEVEL + MARGIN - most(*word)).max(0.0)).reduce(f64::min);
        let excess = example.never.iter().map(|word| (most(*word) - LEVEL + MARGIN).max(0.0)).sum::<f64>();
        example.sure * (short.unwrap_or(0.0) + excess)
    };
    Ok(examples.iter().map(of_one).sum::<f64>() / examples.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel::fcm::load;
    use taxel::fcm::weight::Weight;

    #[test]
    fn a_spoilt_boundary_is_learned_again_and_signs_stay() {
        let good = load::map("tactile").unwrap();
        let mut spoilt = good.clone();
        for edge in spoilt.edge.iter_mut().filter(|edge| edge.to == "attack") {
            if ["time", "shape"].contains(&edge.from.as_str()) {
                edge.weight = Weight::Number(0.05 * edge.weight.value().signum());
            }
        }
        let script = |name: &str| taxel::files::scripts::load(name).unwrap();
        let example = |name: &str, must: &[Leading], never: &[Leading]| {
            let rule = Rule { must: must.to_vec(), never: never.to_vec(), sure: 1.0, ..Rule::default() };
            let heard = hear_all(&[script(name)], None).unwrap().remove(0);
            super::example(0, &rule, &heard, &spoilt)
        };
        let examples = [example("lash", &[Leading::Attack], &[]), example("pat", &[], &[Leading::Attack])];
        let all: Vec<&PlayedScript> = examples.iter().collect();
        let learned = learn(&spoilt, &examples, None).unwrap();
        let [before, after] = [&spoilt, &learned].map(|map| loss(map, &all).unwrap());
        assert!(before > 0.1 && after < 0.01, "{before} {after}");
        let signs = |map: &MapFile| map.edge.iter().map(|it| it.weight.value().signum()).collect::<Vec<_>>();
        assert_eq!(signs(&learned), signs(&good));
        assert_eq!(learn(&spoilt, &examples, Some(0)).unwrap(), spoilt, "nothing is left to learn from");
    }
}
