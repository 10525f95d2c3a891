//! Several maps as one: concepts and edges of all of them, shared edges agreed or combined, and what they
//! disagree on.

use super::aggregate::{Aggregation, centroid};
use super::map::{EdgeFile, MapFile};
use super::member::InputFile;
use super::terms::hundredths;
use super::weight::Weight;
use anyhow::{Result, bail};
use serde_json::{Value, json};

/// What becomes of an edge that maps say differently.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shared {
    /// They must say the same.
    Agree,
    /// What they say is aggregated; a map that has both concepts and no edge says nothing.
    Combine(Aggregation),
    /// The same, and a map that has both concepts and no edge says `none`.
    Vote(Aggregation),
}

/// What was said of an edge, and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Opinions {
    /// The cause.
    pub from: String,
    /// The effect.
    pub to: String,
    /// By the name of the map.
    pub said: Vec<(String, Weight)>,
    /// The weight in the united map.
    pub weight: Weight,
}

impl Opinions {
    /// Distance of the farthest two.
    pub fn spread(&self) -> f64 {
        let values = self.said.iter().map(|(_, weight)| weight.value());
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    }

    /// Whether one says that the cause increases the effect, and another that it decreases it.
    pub fn is_conflict(&self) -> bool {
        let any = |sign: f64| self.said.iter().any(|(_, weight)| weight.value() * sign > 0.0);
        any(1.0) && any(-1.0)
    }

    /// For other programs.
    pub fn json(&self) -> Value {
        let said = self.said.iter().map(|(map, weight)| json!({ "map": map, "weight": weight }));
        json!({
            "from": self.from, "to": self.to, "weight": self.weight, "said": said.collect::<Value>(),
            "spread": self.spread(), "sign_conflict": self.is_conflict(),
        })
    }
}

/// The united map, its edges as they came about, and what else the maps disagree on.
#[derive(Debug, Clone)]
pub struct United {
    /// The map.
    pub map: MapFile,
    /// One for each edge of any map, in the order of the maps.
    pub edges: Vec<Opinions>,
    /// Sentences.
    pub conflicts: Vec<String>,
}

/// Unites maps under a name. Settings, notes, thresholds and inputs are those of the first map that has them.
pub fn unite(maps: &[MapFile], name: &str, shared: Shared) -> Result<United> {
    let [first, ..] = maps else { bail!("there is no map to unite") };
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
                    .push(format!("thresholds of {} differ: that of the first map counts", concept.name));
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

/// Settings that not all have.
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
                found.push(format!("{what} of {} is not that of {}, which counts", other.name, first.name));
            }
        }
    }
    found
}

/// What each map says of an edge that one of them has.
fn opinions(maps: &[MapFile], edge: &EdgeFile, shared: Shared) -> Result<Opinions> {
    let EdgeFile { from, to, .. } = edge;
    let mut said = Vec::new();
    for map in maps {
        match map.edge(from, to) {
            Some(own) => said.push((map.name.clone(), own.weight.clone())),
            None if matches!(shared, Shared::Vote(_))
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
        Shared::Combine(how) | Shared::Vote(how) => Weight::Number(hundredths(centroid(&sets, how)).to_f64()),
        Shared::Agree => {
            let each: Vec<String> = said.iter().map(|(map, weight)| format!("{weight} in {map}")).collect();
            bail!("edge {from} -> {to} is {}: --combine makes one of them", each.join(", "));
        }
    };
    Ok(Opinions { from: from.clone(), to: to.clone(), said, weight })
}

/// Inputs of concepts that nothing in the united map causes.
fn inputs(maps: &[MapFile], map: &mut MapFile, conflicts: &mut Vec<String>) {
    for one in maps {
        for concept in &one.concept {
            let of = |map: &MapFile| -> Vec<InputFile> {
                let inputs = map.input.iter().filter(|input| input.concept == concept.name).cloned();
                // What is said of an input makes no other input of it.
                inputs.map(|input| InputFile { note: String::new(), ..input }).collect()
            };
            let (own, known) = (of(one), of(map));
            if own.is_empty() {
                continue;
            }
            if map.is_driven(&concept.name) {
                conflicts.push(format!(
                    "{} is an input of {} and has causes in another: the causes count",
                    concept.name, one.name
                ));
            } else if known.is_empty() {
                map.input.extend(one.input.iter().filter(|input| input.concept == concept.name).cloned());
            } else if known != own {
                conflicts.push(format!(
                    "the input of {} in {} is not that of the map before, which counts",
                    concept.name, one.name
                ));
            }
        }
    }
}
