//! Unites several maps: all concepts and edges; shared edges must agree or are combined; disagreements are
//! reported.

use super::aggregate::{Aggregation, centroid};
use super::map::{EdgeFile, MapFile};
use super::member::InputFile;
use super::terms::hundredths;
use super::weight::Weight;
use crate::error::{MapFileError, Result};
use serde_json::{Value, json};

/// Treatment of an edge with different weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeConflict {
    /// The weights must be equal.
    Agree,
    /// The weights are aggregated; a map with both concepts but no edge has no vote.
    Combine(Aggregation),
    /// The weights are aggregated; a map with both concepts but no edge votes `none`.
    Vote(Aggregation),
}

/// Weights of an edge by map, and the result.
#[derive(Debug, Clone, PartialEq)]
pub struct Opinions {
    /// The cause.
    pub from: String,
    /// The effect.
    pub to: String,
    /// Weights by name of the map.
    pub said: Vec<(String, Weight)>,
    /// Weight in the united map.
    pub weight: Weight,
}

impl Opinions {
    /// Difference between the two extreme weights.
    pub fn spread(&self) -> f64 {
        let values = self.said.iter().map(|(_, weight)| weight.value());
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    }

    /// True if weights of both signs occur.
    pub fn is_conflict(&self) -> bool {
        let any = |sign: f64| self.said.iter().any(|(_, weight)| weight.value() * sign > 0.0);
        any(1.0) && any(-1.0)
    }

    /// Encodes as JSON.
    pub fn json(&self) -> Value {
        let said = self.said.iter().map(|(map, weight)| json!({ "map": map, "weight": weight }));
        json!({
            "from": self.from, "to": self.to, "weight": self.weight, "said": said.collect::<Value>(),
            "spread": self.spread(), "sign_conflict": self.is_conflict(),
        })
    }
}

/// The united map, its edges with their origin, and other disagreements.
#[derive(Debug, Clone)]
pub struct United {
    /// The map.
    pub map: MapFile,
    /// One for each edge of any map, in the order of the maps.
    pub edges: Vec<Opinions>,
    /// Disagreements in sentences.
    pub conflicts: Vec<String>,
}

/// Unites maps under a name. Settings, notes, thresholds and inputs are those of the first map that has them.
pub fn unite(maps: &[MapFile], name: &str, shared: EdgeConflict) -> Result<United> {
    let [first, ..] = maps else { fail!(MapFileError::Unanswerable, "there is no map to unite") };
    let mut map = MapFile {
        name: name.into(),
        concept: Vec::new(),
        input: Vec::new(),
        edge: Vec::new(),
        ..first.clone()
    };
    let mut conflicts = settings(maps);
    for concept in maps.iter().flat_map(|one| &one.concept) {
        match map.find(&concept.name) {
            None => map.concept.push(concept.clone()),
            Some(at) if map.concept[at].threshold != concept.threshold => {
                conflicts
                    .push(format!("thresholds of {} differ: that of the first map is used", concept.name));
            }
            Some(_) => {}
        }
    }
    let mut edges: Vec<Opinions> = Vec::new();
    for edge in maps.iter().flat_map(|one| &one.edge) {
        if edges.iter().any(|known| known.from == edge.from && known.to == edge.to) {
            continue;
        }
        let opinions = opinions(maps, edge, shared)?;
        let weight = opinions.weight.clone();
        if weight.value() != 0.0 {
            map.edge.push(EdgeFile { weight, ..edge.clone() });
        }
        edges.push(opinions);
    }
    inputs(maps, &mut map, &mut conflicts);
    Ok(United { map, edges, conflicts })
}

/// Disagreements about settings.
fn settings(maps: &[MapFile]) -> Vec<String> {
    let mut found = Vec::new();
    for other in &maps[1..] {
        let first = &maps[0];
        for (what, same) in [
            ("rule", first.rule == other.rule),
            ("transfer", first.transfer == other.transfer),
            ("lambda", first.lambda == other.lambda),
            ("threshold", first.threshold == other.threshold),
            ("held", first.held == other.held),
        ] {
            if !same {
                found.push(format!(
                    "{what} of {} differs from that of {}, which is used",
                    other.name, first.name
                ));
            }
        }
    }
    found
}

/// Weights of an edge in each map.
fn opinions(maps: &[MapFile], edge: &EdgeFile, shared: EdgeConflict) -> Result<Opinions> {
    let EdgeFile { from, to, .. } = edge;
    let mut said = Vec::new();
    for map in maps {
        match map.edge(from, to) {
            Some(own) => said.push((map.name.clone(), own.weight.clone())),
            None if matches!(shared, EdgeConflict::Vote(_))
                && map.find(from).is_some()
                && map.find(to).is_some() =>
            {
                said.push((map.name.clone(), Weight::Term("none".into())));
            }
            None => {}
        }
    }
    let same = said.iter().all(|(_, weight)| *weight == edge.weight);
    let sets: Vec<_> = said.iter().map(|(_, weight)| weight.set()).collect();
    let weight = match shared {
        _ if same => edge.weight.clone(),
        EdgeConflict::Combine(how) | EdgeConflict::Vote(how) => {
            Weight::Number(hundredths(centroid(&sets, how)).to_f64())
        }
        EdgeConflict::Agree => {
            let each: Vec<String> = said.iter().map(|(map, weight)| format!("{weight} in {map}")).collect();
            fail!(
                MapFileError::Unanswerable,
                "edge {from} -> {to} is {}: --combine makes them one",
                each.join(", ")
            );
        }
    };
    Ok(Opinions { from: from.clone(), to: to.clone(), said, weight })
}

/// Collects the inputs of concepts without causes in the united map.
fn inputs(maps: &[MapFile], map: &mut MapFile, conflicts: &mut Vec<String>) {
    for one in maps {
        for concept in &one.concept {
            let of = |map: &MapFile| -> Vec<InputFile> {
                let inputs = map.input.iter().filter(|input| input.concept == concept.name).cloned();
                // Inputs that differ only in their notes are equal.
                inputs.map(|input| InputFile { note: String::new(), ..input }).collect()
            };
            let (own, known) = (of(one), of(map));
            if own.is_empty() {
                continue;
            }
            if map.is_driven(&concept.name) {
                conflicts.push(format!(
                    "{} is an input of {} and has causes in another: the causes are used",
                    concept.name, one.name
                ));
            } else if known.is_empty() {
                map.input.extend(one.input.iter().filter(|input| input.concept == concept.name).cloned());
            } else if known != own {
                conflicts.push(format!(
                    "the input of {} in {} differs from that of the map before, which is used",
                    concept.name, one.name
                ));
            }
        }
    }
}
