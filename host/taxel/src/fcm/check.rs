//! Finds faults of a map, and what its author may not have intended.

use super::board::{BoardMap, STEPS};
use super::decimal::Decimal;
use super::map::MapFile;
use super::sweep::{Sweep, sweep};
use crate::client::scene_bytes;
use crate::error::{Context, Result};
use serde_json::{Value, json};
use taxel_core::intent::{IntentConfig, Leading, MapConfig};
use taxel_core::scene::Scene;

/// Results of a check.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Reasons why the board cannot use the map.
    pub faults: Vec<String>,
    /// Properties that are probably not intended.
    pub warnings: Vec<String>,
    /// Behaviour of the map.
    pub sweep: Sweep,
}

/// Checks a map. Error if not even the host's engine accepts it.
pub fn check(map: &MapFile) -> Result<Findings> {
    BoardMap::build(map)?;
    let sweep = sweep(map)?;
    let mut warnings: Vec<String> = structure(map).into_iter().chain(behaviour(&sweep)).collect();
    warnings.dedup();
    Ok(Findings {
        faults: board(map).err().map(|error| format!("{error:#}")).into_iter().collect(),
        warnings,
        sweep,
    })
}

/// Checks that the board can hold the map and announce intentions by it.
fn board(map: &MapFile) -> Result<()> {
    let config: MapConfig = *map.to_config()?;
    let mut scene = Scene::shipped();
    // The shipped reactions name concepts of the shipped map.
    scene.react.clear();
    scene.intent = Some(IntentConfig::new(config));
    scene_bytes(&scene).context("with this map as the shipped one").map(drop)
}

/// Warnings about unconnected concepts and rings.
fn structure(map: &MapFile) -> Vec<String> {
    let mut found = Vec::new();
    let fed = |name: &str| map.input.iter().any(|input| input.concept == name);
    for concept in map.entries() {
        if !fed(concept) {
            found.push(format!(
                "concept {concept} has neither an input nor a cause: it keeps its initial value"
            ));
        }
        if !map.edge.iter().any(|edge| edge.from == concept) {
            found.push(format!("concept {concept} causes nothing"));
        }
    }
    let reached = reached(map);
    let intentions = Leading::INTENTIONS.map(Leading::as_str);
    for intention in intentions.into_iter().filter(|name| map.find(name).is_some()) {
        if !reached.contains(&intention) {
            found.push(format!("no input reaches the intention {intention}"));
        }
    }
    if intentions.iter().all(|name| map.find(name).is_none()) {
        found.push("no concept is kindness, threat or attack: the board has nothing to announce".into());
    }
    if let Some(ring) = ring(map) {
        found.push(format!("causes go round: {}", ring.join(" -> ")));
    }
    found
}

/// Concepts reached from an input, in the order of the search.
fn reached(map: &MapFile) -> Vec<&str> {
    let mut reached: Vec<&str> = map.input.iter().map(|input| input.concept.as_str()).collect();
    let mut next = 0;
    while let Some(cause) = reached.get(next).copied() {
        next += 1;
        for edge in map.edge.iter().filter(|edge| edge.from == cause && edge.weight.value() != 0.0) {
            if !reached.contains(&edge.to.as_str()) {
                reached.push(&edge.to);
            }
        }
    }
    reached
}

/// One ring of causes, beginning and ending with the same concept.
fn ring(map: &MapFile) -> Option<Vec<&str>> {
    // After repeated removal of concepts without a cause, the rest is on a ring or behind one.
    let mut left: Vec<&str> = map.concept.iter().map(|c| c.name.as_str()).collect();
    let causes = |to: &str, left: &[&str]| {
        let edges = map.edge.iter().filter(|edge| edge.to == to && edge.weight.value() != 0.0);
        edges.map(|edge| edge.from.as_str()).find(|from| left.contains(from))
    };
    while let Some(at) = left.iter().position(|name| causes(name, &left).is_none()) {
        left.remove(at);
    }
    let mut path = vec![*left.first()?];
    loop {
        let cause = causes(path[path.len() - 1], &left)?;
        let before = path.iter().position(|name| *name == cause);
        path.push(cause);
        if let Some(before) = before {
            path.drain(..before);
            path.reverse();
            return Some(path);
        }
    }
}

/// Warnings about maps that cycle or do not settle.
fn behaviour(sweep: &Sweep) -> Vec<String> {
    let mut found = Vec::new();
    if let (count, Some((inputs, period))) = &sweep.cycles {
        let of = sweep.starts;
        found
            .push(format!("cycles from {count} of {of} inputs, with period {period} from {}", words(inputs)));
    }
    if let (count, Some(inputs)) = &sweep.unsettled {
        let of = sweep.starts;
        found.push(format!(
            "does not settle in {STEPS} steps from {count} of {of} inputs, such as {}",
            words(inputs)
        ));
    }
    let allowed = IntentConfig::<1, 1>::new(MapConfig::default()).steps;
    if sweep.steps > allowed {
        found.push(format!(
            "takes up to {} steps to settle, and a scene allows {allowed} unless it says more",
            sweep.steps
        ));
    }
    found
}

fn words(inputs: &[(String, Decimal)]) -> String {
    if inputs.is_empty() {
        return "no input at all".into();
    }
    inputs.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
}

/// `{"map", "concepts", "edges", "faults", "warnings", "starts", "steps", "cycles", "unsettled"}`.
pub fn report(map: &MapFile, found: &Findings) -> Value {
    let Findings { faults, warnings, sweep } = found;
    json!({
        "map": map.name, "concepts": map.concept.len(), "edges": map.edge.len(),
        "faults": faults, "warnings": warnings, "starts": sweep.starts, "steps": sweep.steps,
        "cycles": sweep.cycles.0, "unsettled": sweep.unsettled.0,
    })
}

/// Readable form.
pub fn in_words(map: &MapFile, found: &Findings) -> String {
    let Findings { faults, warnings, sweep } = found;
    let mut text = format!(
        "map {}: {} concepts, {} edges, {} inputs\n",
        map.name,
        map.concept.len(),
        map.edge.len(),
        map.input.len()
    );
    faults.iter().for_each(|fault| text += &format!("fault: {fault}\n"));
    warnings.iter().for_each(|warning| text += &format!("warning: {warning}\n"));
    let settled = sweep.starts - sweep.cycles.0 - sweep.unsettled.0;
    text += &format!("settles from {settled} of {} inputs, within {} steps\n", sweep.starts, sweep.steps);
    text
}
