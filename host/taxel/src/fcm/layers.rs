//! Layers of a drawn map: causes left of their effects.

use serde::Serialize;
use taxel_core::intent::{Leading, MapConfig};

/// Part of a concept in a map that reads from touch to mood.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Measured or reported: nothing causes it.
    Felt,
    /// Meaning of what is felt: an intention, or a cause of one.
    Meaning,
    /// Feeling about the meaning: it lies behind all intentions.
    Feeling,
}

/// Layer and role of each concept of a board's map.
pub fn of_config(map: &MapConfig) -> Vec<(usize, Role)> {
    let edges = map.edges.iter().filter(|edge| edge.weight != 0);
    let ends: Vec<_> = edges.map(|edge| (usize::from(edge.from), usize::from(edge.to))).collect();
    let layers = layers(map.concepts.len(), &ends);
    let is_intention =
        |at: usize| Leading::INTENTIONS.iter().any(|of| of.as_str() == map.concepts[at].as_str());
    let last = (0..layers.len()).filter(|at| is_intention(*at)).map(|at| layers[at]).max();
    let role = |at: usize| match layers[at] {
        _ if is_intention(at) => Role::Meaning,
        0 => Role::Felt,
        layer if last.is_some_and(|last| layer > last) => Role::Feeling,
        _ => Role::Meaning,
    };
    (0..layers.len()).map(|at| (layers[at], role(at))).collect()
}

/// Layer of each of `n` concepts, from the edges as pairs of cause and effect: 0 without a cause, else one more
/// than the highest layer of its causes. Edges that close a ring are ignored.
fn layers(n: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let forward = forward(n, edges);
    let mut layers = vec![0; n];
    // Without rings, no path is longer than the number of concepts.
    for _ in 0..n {
        for (from, to) in &forward {
            layers[*to] = layers[*to].max(layers[*from] + 1);
        }
    }
    layers
}

/// The edges except for those that a depth-first search finds to close a ring.
fn forward(n: usize, edges: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let mut kept = Vec::new();
    let mut done = vec![false; n];
    // Concepts without a cause first, so that rings are entered from outside.
    let mut starts: Vec<usize> = (0..n).collect();
    starts.sort_by_key(|at| edges.iter().any(|(_, to)| to == at));
    for start in starts {
        visit(start, edges, &mut done, &mut vec![false; n], &mut kept);
    }
    kept
}

fn visit(
    at: usize,
    edges: &[(usize, usize)],
    done: &mut [bool],
    under_way: &mut [bool],
    kept: &mut Vec<(usize, usize)>,
) {
    if std::mem::replace(&mut done[at], true) {
        return;
    }
    under_way[at] = true;
    for edge in edges.iter().filter(|(from, _)| *from == at) {
        if !under_way[edge.1] {
            kept.push(*edge);
            visit(edge.1, edges, done, under_way, kept);
        }
    }
    under_way[at] = false;
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::scene::Scene;

    #[test]
    fn the_shipped_map_leads_from_what_is_felt_to_feelings() {
        let intent = Scene::shipped().intent.unwrap();
        let (layers, roles): (Vec<_>, Vec<_>) = of_config(&intent.map).into_iter().unzip();
        let wanted =
            [[Role::Felt; 4].as_slice(), &[Role::Meaning; 3], &[Role::Feeling; 3], &[Role::Felt; 10]];
        assert_eq!(roles[..20], wanted.concat());
        assert_eq!(layers[..10], [0, 0, 0, 0, 3, 2, 1, 4, 4, 5]);
        assert_eq!(layers[10..20], [0; 10], "what is measured beside");
        assert_eq!(layers[20..], [1, 1], "sting and grip, of which threat follows");
    }

    #[test]
    fn a_ring_has_an_end() {
        assert_eq!(layers(3, &[(2, 0), (0, 1), (1, 0), (1, 1)]), [1, 2, 0]);
    }
}
