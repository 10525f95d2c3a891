//! Converts a map file to the core's configuration, which numbers concepts and counts in decimal steps.

use super::map::{ConceptFile, EdgeFile, MapFile};
use super::member::InputFile;
use super::steps::{decimal, steps};
use super::weight::Weight;
use super::wrong::wrong;
use crate::error::{Error, MapFileError, Result};
use crate::text::words::Step::{self, At, Key};
use taxel_core::format::{Name, name};
use taxel_core::intent::{Edge, MapConfig, Threshold};

impl MapFile {
    /// The map in the core's decimal steps, as fine as the file's numbers need.
    pub fn to_config<const N: usize, const E: usize>(&self) -> Result<Box<MapConfig<N, E>>> {
        self.check_numbers()?;
        let decimals = self.decimals();
        let at =
            |at: &'static [Step<'static>]| move |why: Error| wrong(at, format!("map {}: {why}", self.name));
        let inside = |list: &'static str, index: usize, key: Option<&'static str>| {
            let steps: Vec<_> = [Key(list), At(index)].into_iter().chain(key.map(Key)).collect();
            move |why: Error| wrong(&steps, format!("map {}: {why}", self.name))
        };
        let mut config = Box::new(MapConfig {
            name: fitting(&self.name, "name").map_err(|why| wrong(&[Key("name")], why))?,
            decimals: decimals as u8,
            rule: self.rule,
            transfer: self.transfer,
            lambda: decimal(self.lambda, 3, "lambda").map_err(at(&[Key("lambda")]))? as u16,
            threshold: steps(self.threshold, decimals, || "threshold".into())?,
            held: self.held,
            ..MapConfig::default()
        });
        let full = |what: &str, found, room| {
            error!(MapFileError::TooLarge, "map {}: {found} {what}, and there is room for {room}", self.name)
        };
        for (number, concept) in self.concept.iter().enumerate() {
            let short = fitting(&concept.name, "concept").map_err(inside("concept", number, Some("name")))?;
            config.concepts.push(short).map_err(|_| full("concepts", self.concept.len(), N))?;
            if let Some(own) = concept.threshold {
                let value = steps(own, decimals, || format!("threshold of {}", concept.name))?;
                let own = Threshold { concept: u8::try_from(number)?, value };
                config.thresholds.push(own).map_err(|_| full("thresholds", number, N))?;
            }
        }
        for edge in &self.edge {
            let number = |concept| Ok::<u8, Error>(u8::try_from(self.index(concept, "an edge")?)?);
            let weight = steps(edge.weight.value(), decimals, || format!("W[{}][{}]", edge.from, edge.to))?;
            let edge = Edge { from: number(&edge.from)?, to: number(&edge.to)?, weight };
            config.edges.push(edge).map_err(|_| full("edges", self.edge.len(), E))?;
        }
        let mut of_robot = 0..=u8::MAX;
        for (number, input) in self.input.iter().enumerate() {
            let slot = match input.robot {
                Some(_) => of_robot.next().ok_or_else(|| full("inputs", self.input.len(), 256))?,
                None => 0,
            };
            let known = self.index(&input.concept, "an input");
            let concept =
                u8::try_from(known.map_err(|why| wrong(&[Key("input"), At(number), Key("concept")], why))?)?;
            for ramp in input.inputs(concept, decimals, slot).map_err(inside("input", number, None))? {
                config.inputs.push(ramp).map_err(|_| full("inputs", self.input.len(), N))?;
            }
        }
        Ok(config)
    }

    /// The map file of a configuration.
    pub fn from_config<const N: usize, const E: usize>(config: &MapConfig<N, E>) -> MapFile {
        let step = 10f64.powi(config.decimals.into());
        let decimal = |steps: i16| f64::from(steps) / step;
        let called = |at: u8| config.concepts.get(usize::from(at)).map_or(at.to_string(), |n| n.to_string());
        let own = |at: usize| config.thresholds.iter().find(|t| usize::from(t.concept) == at);
        let concept = |(at, name): (usize, &Name)| ConceptFile {
            name: name.to_string(),
            threshold: own(at).map(|own| decimal(own.value)),
            ..ConceptFile::default()
        };
        let edge = |edge: &Edge| EdgeFile {
            from: called(edge.from),
            to: called(edge.to),
            weight: Weight::Number(decimal(edge.weight)),
            fixed: false,
            note: String::new(),
        };
        let inputs = (0..config.concepts.len() as u8).flat_map(|at| {
            let own: Vec<_> = config.inputs.iter().filter(|input| input.concept == at).collect();
            InputFile::of(&called(at), &own, config.decimals)
        });
        MapFile {
            rule: config.rule,
            transfer: config.transfer,
            lambda: f64::from(config.lambda) / 1000.0,
            threshold: decimal(config.threshold),
            held: config.held,
            concept: config.concepts.iter().enumerate().map(concept).collect(),
            input: inputs.collect(),
            edge: config.edges.iter().map(edge).collect(),
            ..MapFile::empty(&config.name)
        }
    }
}

/// A text as a [`Name`], which must not be truncated: two names could become equal.
fn fitting(text: &str, what: &str) -> Result<Name> {
    let short = name(text);
    if short != text {
        fail!(MapFileError::TooLarge, "{what} {text} is longer than 16 bytes");
    }
    Ok(short)
}
