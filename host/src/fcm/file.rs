//! Maps as files: the JSON of the reference cases (`names`, `W`, `x0`), and a TOML that names concepts instead of
//! numbering them.

use super::decimal::Decimal;
use super::engine::Problem;
use anyhow::{Context, Result, anyhow, bail};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;
use taxel_core::format::{Name, name};
use taxel_core::intent::{Edge, Input, MapConfig, Rule, Source, Threshold, Transfer};

/// Reads a JSON map. Every error is a sentence with the file, the field and the value.
pub fn read_json(path: &Path) -> Result<Problem> {
    let file = path.display();
    let text = std::fs::read_to_string(path).with_context(|| format!("{file}: cannot be read"))?;
    parse_json(&text).map_err(|error| anyhow!("{file}: {error}"))
}

/// Reads the text of a JSON map.
pub fn parse_json(text: &str) -> Result<Problem> {
    let value: Value = serde_json::from_str(text).map_err(|error| not_json(text, &error))?;
    let names = array(&value, "names")?;
    let names: Vec<String> = names
        .iter()
        .enumerate()
        .map(|(i, n)| n.as_str().map(String::from).ok_or_else(|| anyhow!("names[{i}] = {n} is not a text")))
        .collect::<Result<_>>()?;
    let n = names.len();
    if n == 0 {
        bail!("names is empty");
    }
    if let Some(twice) = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
        bail!("names: {} is given twice", twice.1);
    }
    let rows = sized(array(&value, "W")?, n, "W", "rows")?;
    let mut weights = Vec::with_capacity(n);
    for (from, row) in names.iter().zip(rows) {
        let row = row.as_array().ok_or_else(|| anyhow!("W[{from}] is not a list of numbers"))?;
        let row = sized(row, n, &format!("W[{from}]"), "values")?;
        let row = names.iter().zip(row).map(|(to, w)| fraction(w, || format!("W[{from}][{to}]")));
        weights.push(row.collect::<Result<_>>()?);
    }
    let start = sized(array(&value, "x0")?, n, "x0", "values")?;
    let start = names.iter().zip(start).map(|(concept, v)| fraction(v, || format!("x0[{concept}]")));
    Ok(Problem { weights, start: start.collect::<Result<_>>()?, names })
}

/// JSON has no NaN, but programs write it: say so instead of "expected value".
fn not_json(text: &str, error: &serde_json::Error) -> anyhow::Error {
    let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or("");
    let rest = line.get(error.column().saturating_sub(1)..).unwrap_or("");
    match ["NaN", "Infinity", "-Infinity"].into_iter().find(|word| rest.starts_with(word)) {
        Some(word) => anyhow!("line {}: {word} is not a finite number", error.line()),
        None => anyhow!("not JSON: {error}"),
    }
}

fn array<'a>(value: &'a Value, key: &str) -> Result<&'a Vec<Value>> {
    let object = value.as_object().context("not a JSON object with the keys names, W and x0")?;
    let field = object.get(key).with_context(|| format!("{key} is missing"))?;
    field.as_array().with_context(|| format!("{key} is not a list"))
}

fn sized<'a>(list: &'a Vec<Value>, n: usize, field: &str, unit: &str) -> Result<&'a Vec<Value>> {
    if list.len() != n {
        bail!("{field} has {} {unit}, and there are {n} concepts", list.len());
    }
    Ok(list)
}

fn fraction(value: &Value, field: impl Fn() -> String) -> Result<Decimal> {
    let Value::Number(number) = value else { bail!("{} = {value} is not a finite number", field()) };
    let text = number.to_string();
    if number.as_f64().is_some_and(|v| v.abs() > 1.0) {
        bail!("{} = {} is outside [-1, 1]", field(), text.strip_suffix(".0").unwrap_or(&text));
    }
    Decimal::parse(&text).with_context(|| format!("{} = {text} has more than 17 decimals", field()))
}

/// An edge of a [`MapFile`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EdgeFile {
    /// Name of the cause.
    pub from: String,
    /// Name of the effect.
    pub to: String,
    /// Causality value, -1 ..= 1, at most four decimals.
    pub weight: f64,
}

/// An input of a [`MapFile`]: `low` and `high` in the unit of the source.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputFile {
    /// Name of the concept.
    pub concept: String,
    /// Where the value comes from.
    pub source: Source,
    /// Start of the ramp.
    pub low: i32,
    /// End of the ramp.
    pub high: i32,
    /// Activation up to `low`.
    pub at_low: f64,
    /// Activation from `high` on.
    pub at_high: f64,
}

/// A map as a person writes it, in TOML: concepts by name, numbers in decimals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapFile {
    /// What the map is called.
    pub name: String,
    /// Names of the concepts, at most 16 bytes each.
    pub concepts: Vec<String>,
    /// What is summed; kosko if absent.
    #[serde(default)]
    pub rule: Rule,
    /// What the sum becomes; tanh if absent.
    #[serde(default)]
    pub transfer: Transfer,
    /// Steepness; 1 if absent.
    #[serde(default = "one")]
    pub lambda: f64,
    /// Threshold of every concept; 0 if absent.
    #[serde(default)]
    pub threshold: f64,
    /// Thresholds of single concepts, by name.
    #[serde(default)]
    pub thresholds: std::collections::BTreeMap<String, f64>,
    /// Whether concepts without an incoming edge keep their value; true if absent.
    #[serde(default = "yes")]
    pub held: bool,
    /// Causal edges.
    #[serde(default)]
    pub edges: Vec<EdgeFile>,
    /// Inputs.
    #[serde(default)]
    pub inputs: Vec<InputFile>,
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

impl MapFile {
    /// The map in the core's decimal steps; the step is the finest one that the file uses.
    pub fn to_config<const N: usize, const E: usize>(&self) -> Result<MapConfig<N, E>> {
        let weights = self.edges.iter().map(|e| e.weight);
        let ends = self.inputs.iter().flat_map(|i| [i.at_low, i.at_high]);
        let all = weights.chain(ends).chain(self.thresholds.values().copied()).chain([self.threshold]);
        let decimals = all.filter_map(Decimal::from_f64).map(|d| d.decimals).max().unwrap_or(0).min(4);
        let lambda = decimal(self.lambda, 3, "lambda")?;
        let mut config = MapConfig {
            name: fitting(&self.name, "name")?,
            decimals: decimals as u8,
            rule: self.rule,
            transfer: self.transfer,
            lambda: u16::try_from(lambda)
                .map_err(|_| anyhow!("lambda = {} is outside 0.001 ..= 65.535", self.lambda))?,
            threshold: steps(self.threshold, decimals, || "threshold".into())?,
            held: self.held,
            ..MapConfig::default()
        };
        let full = |what: &str| anyhow!("map {}: too many {what}", self.name);
        for concept in &self.concepts {
            config.concepts.push(fitting(concept, "concept")?).map_err(|_| full("concepts"))?;
        }
        for edge in &self.edges {
            let field = || format!("W[{}][{}]", edge.from, edge.to);
            let (from, to) = (self.index(&edge.from, "an edge")?, self.index(&edge.to, "an edge")?);
            let weight = steps(edge.weight, decimals, field)?;
            config.edges.push(Edge { from, to, weight }).map_err(|_| full("edges"))?;
        }
        for (concept, value) in &self.thresholds {
            let value = steps(*value, decimals, || format!("thresholds.{concept}"))?;
            let threshold = Threshold { concept: self.index(concept, "a threshold")?, value };
            config.thresholds.push(threshold).map_err(|_| full("thresholds"))?;
        }
        for input in &self.inputs {
            let at = |v: f64, end: &str| steps(v, decimals, || format!("input {}: {end}", input.concept));
            let (at_low, at_high) = (at(input.at_low, "at_low")?, at(input.at_high, "at_high")?);
            let concept = self.index(&input.concept, "an input")?;
            let input =
                Input { concept, source: input.source, low: input.low, high: input.high, at_low, at_high };
            config.inputs.push(input).map_err(|_| full("inputs"))?;
        }
        Ok(config)
    }

    /// The readable form of a map.
    pub fn from_config<const N: usize, const E: usize>(config: &MapConfig<N, E>) -> MapFile {
        let step = 10f64.powi(config.decimals.into());
        let decimal = |steps: i16| f64::from(steps) / step;
        let concept = |at: u8| config.concepts.get(usize::from(at)).map_or(at.to_string(), |n| n.to_string());
        MapFile {
            name: config.name.to_string(),
            concepts: config.concepts.iter().map(|n| n.to_string()).collect(),
            rule: config.rule,
            transfer: config.transfer,
            lambda: f64::from(config.lambda) / 1000.0,
            threshold: decimal(config.threshold),
            thresholds: config.thresholds.iter().map(|t| (concept(t.concept), decimal(t.value))).collect(),
            held: config.held,
            edges: (config.edges.iter())
                .map(|e| EdgeFile { from: concept(e.from), to: concept(e.to), weight: decimal(e.weight) })
                .collect(),
            inputs: (config.inputs.iter())
                .map(|i| InputFile {
                    concept: concept(i.concept),
                    source: i.source,
                    low: i.low,
                    high: i.high,
                    at_low: decimal(i.at_low),
                    at_high: decimal(i.at_high),
                })
                .collect(),
        }
    }

    fn index(&self, concept: &str, user: &str) -> Result<u8> {
        let at = self.concepts.iter().position(|name| name == concept);
        let at =
            at.with_context(|| format!("map {}: {user} names the unknown concept {concept}", self.name))?;
        Ok(u8::try_from(at)?)
    }
}

/// A text that must fit into a [`Name`] whole: two that are cut could become one.
fn fitting(text: &str, what: &str) -> Result<Name> {
    let short = name(text);
    if short != text {
        bail!("{what} {text} is longer than 16 bytes");
    }
    Ok(short)
}

/// `value` in steps of 10^-`decimals`; it must be a whole number of them.
fn decimal(value: f64, decimals: u32, field: &str) -> Result<i128> {
    let exact = Decimal::from_f64(value).filter(|d| d.decimals <= decimals);
    let exact =
        exact.with_context(|| format!("{field} = {value} is not a number of at most {decimals} decimals"))?;
    Ok(exact.scaled(10i128.pow(decimals)))
}

/// A value in -1 ..= 1 in steps of 10^-`decimals`. The range is checked here because i16 ends at 3.2767.
fn steps(value: f64, decimals: u32, field: impl Fn() -> String) -> Result<i16> {
    if value.abs() > 1.0 {
        bail!("{} = {value} is outside [-1, 1]", field());
    }
    let all = decimal(value, 4, &field())?;
    Ok((all / 10i128.pow(4 - decimals)) as i16)
}
