//! Map files: TOML with named concepts and notes.

use super::decimal::Decimal;
use super::engine::{Problem, Settings};
use super::member::InputFile;
use super::robot_source::RobotInput;
use super::steps::steps;
use super::weight::Weight;
use super::wrong::wrong;
use crate::error::{MapFileError, Result};
use crate::text::words::Step::{self, At, Key};
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use taxel_core::intent::{Rule, Transfer};

/// Version of the format that this program reads and writes.
pub const VERSION: u32 = 1;

/// A concept of a [`MapFile`].
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConceptFile {
    /// Name; at most 16 bytes for the board.
    pub name: String,
    /// Meaning.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// Threshold of this concept, instead of the map's, -1 ..= 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f64>,
}

/// An edge of a [`MapFile`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EdgeFile {
    /// Name of the cause.
    pub from: String,
    /// Name of the effect.
    pub to: String,
    /// Causality value: a number in -1 ..= 1 of at most four decimals, or a term.
    pub weight: Weight,
    /// True if learning must not change it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fixed: bool,
    /// Reason for the edge.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// A map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapFile {
    /// Version of the format; 1 if absent.
    #[serde(default = "version")]
    pub version: u32,
    /// Name of the map.
    pub name: String,
    /// Purpose of the map.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// Rule of the sum; kosko if absent.
    #[serde(default)]
    pub rule: Rule,
    /// Transfer function of the sum; tanh if absent.
    #[serde(default)]
    pub transfer: Transfer,
    /// Steepness; 1 if absent.
    #[serde(default = "one")]
    pub lambda: f64,
    /// Threshold of every concept; 0 if absent.
    #[serde(default)]
    pub threshold: f64,
    /// True if concepts without an incoming edge keep their value; true if absent.
    #[serde(default = "yes")]
    pub held: bool,
    /// Concepts, in the order of every state.
    #[serde(default)]
    pub concept: Vec<ConceptFile>,
    /// Inputs.
    #[serde(default)]
    pub input: Vec<InputFile>,
    /// Causal edges.
    #[serde(default)]
    pub edge: Vec<EdgeFile>,
}

fn version() -> u32 {
    VERSION
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

impl MapFile {
    /// A map without concepts, with default settings.
    pub fn empty(name: &str) -> MapFile {
        MapFile {
            version: VERSION,
            name: name.into(),
            note: String::new(),
            rule: Rule::default(),
            transfer: Transfer::default(),
            lambda: one(),
            threshold: 0.0,
            held: yes(),
            concept: Vec::new(),
            input: Vec::new(),
            edge: Vec::new(),
        }
    }

    /// Number of a concept, if it exists.
    pub fn find(&self, concept: &str) -> Option<usize> {
        self.concept.iter().position(|c| c.name == concept)
    }

    /// Number of a concept that must exist; `user` names what refers to it.
    pub fn index(&self, concept: &str, user: &str) -> Result<usize> {
        self.find(concept).ok_or_else(|| {
            let (map, user, concept) = (self.name.clone(), user.into(), concept.into());
            MapFileError::NoConcept { map, user, concept }.into()
        })
    }

    /// The edge between two concepts.
    pub fn edge(&self, from: &str, to: &str) -> Option<&EdgeFile> {
        self.edge.iter().find(|edge| edge.from == from && edge.to == to)
    }

    /// True if an edge leads to the concept.
    pub fn is_driven(&self, concept: &str) -> bool {
        self.edge.iter().any(|edge| edge.to == concept && edge.weight.value() != 0.0)
    }

    /// Concepts that are set from outside of the map: those with an input, else those without a cause.
    pub fn entries(&self) -> Vec<&str> {
        let names = self.concept.iter().map(|c| c.name.as_str());
        names.filter(|name| !self.is_driven(name)).collect()
    }

    /// Returns what it hears of a robot, by the slots of its configuration.
    pub(crate) fn robot_inputs(&self) -> Vec<RobotInput> {
        self.input.iter().filter_map(InputFile::of_robot).collect()
    }

    /// Most decimals of any number of the map, at most the core's four.
    pub fn decimals(&self) -> u32 {
        let weights = self.edge.iter().map(|e| e.weight.value());
        let ends = self.input.iter().flat_map(|i| i.at.unwrap_or([0.0, 1.0]));
        let own = self.concept.iter().filter_map(|c| c.threshold);
        let all = weights.chain(ends).chain(own).chain([self.threshold]);
        all.filter_map(Decimal::from_f64).map(|d| d.decimals).max().unwrap_or(0).min(4)
    }

    /// The map as both engines take it, started from `start` (concepts that it does not name are 0).
    pub fn problem(&self, start: &[(String, Decimal)]) -> Result<(Problem, Settings)> {
        self.check_numbers()?;
        let n = self.concept.len();
        let exact = |value: f64| Decimal::from_f64(value).unwrap_or_default();
        let mut problem = Problem {
            names: self.concept.iter().map(|c| c.name.clone()).collect(),
            weights: vec![vec![Decimal::default(); n]; n],
            start: vec![Decimal::default(); n],
            thresholds: self.concept.iter().map(|c| c.threshold.map(exact)).collect(),
        };
        for edge in &self.edge {
            let (from, to) = (self.index(&edge.from, "an edge")?, self.index(&edge.to, "an edge")?);
            problem.weights[from][to] = exact(edge.weight.value());
        }
        for (concept, value) in start {
            problem.start[self.index(concept, "--input")?] = *value;
        }
        let MapFile { rule, transfer, lambda, threshold, held, .. } = *self;
        Ok((problem, Settings { rule, transfer, lambda, threshold: exact(threshold), held }))
    }

    /// Checks that every number is in its range, and every concept name is unique.
    pub fn check_numbers(&self) -> Result<()> {
        let wrong = |at: &[Step<'static>], why: &dyn Display| wrong(at, format!("map {}: {why}", self.name));
        if self.version != VERSION {
            let (map, found) = (&self.name, self.version);
            let text = format!("map {map}: version {found} is not known, this program reads {VERSION}");
            return Err(MapFileError::Version { found, text }.into());
        }
        if self.concept.is_empty() {
            fail!(MapFileError::Malformed, "map {}: it has no concept", self.name);
        }
        for (at, concept) in self.concept.iter().enumerate() {
            let name = &concept.name;
            if self.find(name) != Some(at) {
                let why = format!("concept {name} is named twice");
                return Err(wrong(&[Key("concept"), At(at), Key("name")], &why));
            }
            let own = concept.threshold.unwrap_or(0.0);
            steps(own, 4, || format!("threshold of {name}"))
                .map_err(|why| wrong(&[Key("concept"), At(at), Key("threshold")], &why))?;
        }
        steps(self.threshold, 4, || "threshold".into()).map_err(|why| wrong(&[Key("threshold")], &why))?;
        if !(0.001..=65.535).contains(&self.lambda) {
            let why = format!("lambda = {} is outside 0.001 ..= 65.535", self.lambda);
            return Err(wrong(&[Key("lambda")], &why));
        }
        self.edge.iter().enumerate().try_for_each(|(at, edge)| self.check_edge(at, edge))
    }

    fn check_edge(&self, at: usize, edge: &EdgeFile) -> Result<()> {
        let EdgeFile { from, to, weight, .. } = edge;
        let wrong = |key: &[Step<'static>], why: &dyn Display| {
            wrong(&[&[Key("edge"), At(at)], key].concat(), format!("map {}: {why}", self.name))
        };
        for (key, concept) in [("from", from), ("to", to)] {
            if self.find(concept).is_none() {
                return Err(wrong(&[Key(key)], &format!("an edge names the unknown concept {concept}")));
            }
        }
        steps(weight.value(), 4, || format!("W[{from}][{to}]"))
            .map_err(|why| wrong(&[Key("weight")], &why))?;
        if self.edge[..at].iter().any(|other| other.from == *from && other.to == *to) {
            return Err(wrong(&[], &format!("edge {from} -> {to} is given twice")));
        }
        Ok(())
    }
}
