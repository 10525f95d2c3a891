//! Explains an activation in numbers that add up, and what would change it.

use super::board::{BoardMap, MapState};
use super::decimal::Decimal;
use super::engine::Q15_CONCEPTS;
use super::map::MapFile;
use super::paths::{Shares, shares};
use super::reported::ReportedIntent;
use crate::error::{MapFileError, Result, UsageError};
use serde_json::{Value, json};
use taxel_core::format::Q15;
use taxel_core::intent::{Inference, Leading, Outcome, Why};

/// A settled map, and the explanation of one of its activations.
pub struct Explained {
    /// The map in the arithmetic of the board.
    pub map: BoardMap,
    /// Final state.
    pub run: Inference<Q15_CONCEPTS>,
    /// Contribution of each cause.
    pub why: Why<Q15_CONCEPTS>,
    /// Contributions by inputs and paths.
    pub shares: Shares,
}

/// Settles the map from the inputs and explains a concept.
pub fn explain(file: &MapFile, inputs: &[(String, Decimal)], of: Option<&str>) -> Result<Explained> {
    let map = BoardMap::build(file)?;
    let run = map.infer(&start(file, &map, inputs)?);
    explain_run(file, map, run, of)
}

/// Explains a board's report, from its final state instead of a new inference.
pub fn explain_reported(reported: &ReportedIntent, of: Option<&str>) -> Result<Explained> {
    let leading = Some(reported.report.leading).filter(|leading| *leading != Leading::None);
    let explained =
        explain_state(&reported.map, &reported.report.concepts, of.or(leading.map(Leading::as_str)))?;
    let Inference { state, .. } = explained.run;
    let run = Inference { state, steps: reported.report.steps, outcome: reported.report.outcome };
    Ok(Explained { run, ..explained })
}

/// Explains a concept in a final state of a board, of which steps and outcome are not known.
pub fn explain_state(file: &MapFile, activations: &[Q15], of: Option<&str>) -> Result<Explained> {
    let map = BoardMap::build(file)?;
    let mut state = [0; Q15_CONCEPTS];
    for (slot, value) in state.iter_mut().zip(activations) {
        // The board rounds activations of a threshold map from decimal steps, which are coarser than 2^-15, so
        // this is the exact inverse.
        *slot = (f64::from(value.0) * f64::from(map.map.one()) / 32768.0).round() as i32;
    }
    let run = Inference { state, steps: 0, outcome: Outcome::Fixed };
    explain_run(file, map, run, of)
}

fn explain_run(
    file: &MapFile,
    map: BoardMap,
    run: Inference<Q15_CONCEPTS>,
    of: Option<&str>,
) -> Result<Explained> {
    let concept = match of {
        Some(name) => file.index(name, "--of")?,
        None => strongest(file, &run.state, map.map.one())
            .ok_or_else(|| error!(MapFileError::Unanswerable, "no concept of the map has a cause"))?,
    };
    let name = &file.concept[concept].name;
    let why = map
        .map
        .why(&run.state, concept)
        .ok_or_else(|| error!(MapFileError::Unanswerable, "{name} has no cause: its value was set"))?;
    let shares = shares(&map, &run.state, &why);
    Ok(Explained { map, run, why, shares })
}

fn start(file: &MapFile, map: &BoardMap, inputs: &[(String, Decimal)]) -> Result<MapState> {
    let mut numbered = Vec::new();
    for (name, value) in inputs {
        let concept = file.index(name, "--input")?;
        if file.is_driven(name) {
            fail!(
                UsageError::Argument,
                "--input: {name} has causes, which would overwrite it; --set holds it"
            );
        }
        numbered.push((concept, *value));
    }
    Ok(map.state(numbered))
}

/// An attack if there is one, which may also threaten; else the strongest intention, else the strongest concept with
/// causes; of equal ones the first.
fn strongest(file: &MapFile, state: &MapState, one: i32) -> Option<usize> {
    let is_intention = |name: &str| Leading::INTENTIONS.iter().any(|leading| leading.as_str() == name);
    let driven: Vec<usize> =
        (0..file.concept.len()).filter(|at| file.is_driven(&file.concept[*at].name)).collect();
    let intentions: Vec<usize> =
        driven.iter().copied().filter(|at| is_intention(&file.concept[*at].name)).collect();
    let is_attack =
        |at: &&usize| file.concept[**at].name == Leading::Attack.as_str() && 2 * state[**at] >= one;
    if let Some(attack) = intentions.iter().find(is_attack) {
        return Some(*attack);
    }
    let among = if intentions.is_empty() { driven } else { intentions };
    among.into_iter().rev().max_by_key(|at| state[*at])
}

/// Settles the map with some concepts held.
pub fn what_if(
    file: &MapFile,
    inputs: &[(String, Decimal)],
    set: &[(String, Decimal)],
) -> Result<Inference<Q15_CONCEPTS>> {
    let mut other = file.clone();
    let mut values: Vec<_> =
        inputs.iter().filter(|(name, _)| set.iter().all(|(held, _)| held != name)).cloned().collect();
    for (name, value) in set {
        file.index(name, "--set")?;
        if file.is_driven(name) && !file.held {
            fail!(
                UsageError::Argument,
                "--set: the map lets concepts without causes follow the rule, so {name} cannot be held"
            );
        }
        other.edge.retain(|edge| edge.to != *name);
        values.push((name.clone(), *value));
    }
    let map = BoardMap::build(&other)?;
    Ok(map.infer(&start(&other, &map, &values)?))
}

fn ending(run: &Inference<Q15_CONCEPTS>) -> String {
    match run.outcome {
        Outcome::Fixed => format!("settled after {} steps", run.steps),
        Outcome::Cycle(period) => format!("in a cycle of period {period}: this is its last state"),
        Outcome::Unsettled => format!("not settled in {} steps: this is the last state", run.steps),
    }
}

/// Encodes as JSON in units of 2^-15, which add up exactly.
pub fn report(explained: &Explained, changed: Option<&Inference<Q15_CONCEPTS>>) -> Value {
    let Explained { map, run, why, shares } = explained;
    let names = map.map.concepts();
    let name = |at: usize| names[at].to_string();
    let parts = why.parts.iter().map(|p| json!({ "from": name(p.from.into()), "units": p.value.0 }));
    let paths = shares.paths.iter().map(|path| {
        json!({ "path": path.concepts.iter().map(|at| name(*at)).collect::<Vec<_>>(), "units": path.share })
    });
    let state = |run: &Inference<Q15_CONCEPTS>| -> serde_json::Map<String, Value> {
        names.iter().zip(run.state).map(|(name, x)| (name.to_string(), json!(map.value(x)))).collect()
    };
    let mut value = json!({
        "concept": name(why.concept.into()), "activation": map.value(run.state[usize::from(why.concept)]),
        "ending": ending(run), "unit": "2^-15", "parts": parts.collect::<Value>(),
        "threshold_units": why.threshold.0, "sum_units": why.sum.0,
        "inputs": shares.inputs().into_iter().map(|(at, units)| (name(at), json!(units))).collect::<serde_json::Map<_, _>>(),
        "paths": paths.collect::<Value>(), "rest": shares.rest, "activations": state(run),
    });
    if let Some(changed) = changed {
        value["what_if"] = json!({ "ending": ending(changed), "activations": state(changed) });
    }
    value
}

/// Readable form.
pub fn text(
    file: &MapFile,
    explained: &Explained,
    changed: Option<&Inference<Q15_CONCEPTS>>,
    most: usize,
) -> String {
    let Explained { map, run, why, shares } = explained;
    let name = |at: usize| file.concept[at].name.as_str();
    let line = |units: i64, what: &str| format!("  {:>+9.5} {units:>+8}  {what}\n", units as f64 / 32768.0);
    let concept = usize::from(why.concept);
    let mut text =
        format!("{} is {:.4}; the map {}\n", name(concept), map.value(run.state[concept]), ending(run));
    text += "its causes contribute (number, units of 2^-15)\n";
    for part in &why.parts {
        let note = file.edge(name(part.from.into()), name(concept)).map_or("", |edge| &edge.note);
        let dash = if note.is_empty() { "" } else { ": " };
        text += &line(part.value.0.into(), &format!("{}{dash}{note}", name(part.from.into())));
    }
    text += &line(-i64::from(why.threshold.0), "less the threshold");
    text += &line(why.sum.0.into(), "sum");
    text += "by inputs and paths\n";
    for (input, share) in shares.inputs() {
        text += &line(share, &format!("{} in all", name(input)));
    }
    for path in shares.paths.iter().take(most) {
        let way: Vec<&str> = path.concepts.iter().map(|at| name(*at)).chain([name(concept)]).collect();
        text += &line(path.share, &way.join(" -> "));
    }
    let others: i64 = shares.paths.iter().skip(most).map(|path| path.share).sum();
    if shares.paths.len() > most {
        text += &line(others, &format!("{} other paths", shares.paths.len() - most));
    }
    shares.rest.iter().for_each(|(reason, share)| text += &line(*share, reason));
    text += &line(shares.sum(), "paths and rest");
    if let Some(changed) = changed {
        text += &differences(file, map, run, changed);
    }
    text
}

fn differences(
    file: &MapFile,
    map: &BoardMap,
    run: &Inference<Q15_CONCEPTS>,
    changed: &Inference<Q15_CONCEPTS>,
) -> String {
    let mut text = format!("what if: the map {}\n", ending(changed));
    for (at, concept) in file.concept.iter().enumerate() {
        let (before, after) = (map.value(run.state[at]), map.value(changed.state[at]));
        if before != after {
            text +=
                &format!("  {:<16} {before:>8.4} -> {after:>8.4} ({:+.4})\n", concept.name, after - before);
        }
    }
    text
}
