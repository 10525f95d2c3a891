//! `taxel fcm new`: creates a map in four steps by questions. The answers may also come from a file.

use super::run::{lambda, threshold, transfer};
use crate::commands::tell;
use crate::watch::Overwrite;
use anyhow::{Context, Result, anyhow, bail};
use std::io::{BufRead, IsTerminal, Write};
use std::path::PathBuf;
use taxel::fcm::board::BoardMap;
use taxel::fcm::map::{ConceptFile, EdgeFile, MapFile};
use taxel::fcm::member::InputFile;
use taxel::fcm::weight::Weight;
use taxel::fcm::{load, terms};
use taxel::files::output::Output;
use taxel_core::intent::Source;

/// Arguments of `taxel fcm new`.
#[derive(Debug, Clone, clap::Args)]
pub struct NewArgs {
    /// File to write; the map is named after it
    #[arg(short, long)]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
}

/// Runs the command.
pub fn run(args: NewArgs) -> Result<()> {
    let none: [&PathBuf; 0] = [];
    let output = Output::stream(&args.output, args.force, none)?;
    let (name, is_standard) = (load::name(&output)?, output.is_standard());
    let input = std::io::stdin();
    let patient = input.is_terminal();
    // No questions if the answers are piped in.
    let questions: Box<dyn Write> =
        if patient { Box::new(std::io::stderr()) } else { Box::new(std::io::sink()) };
    let map = Dialog { answers: input.lock(), questions, patient, line: 0 }.map(&name)?;
    load::save(&map, output)?;
    let (file, concepts, edges) = (args.output.display(), map.concept.len(), map.edge.len());
    tell(is_standard, &format!("{file}: {concepts} concepts, {edges} edges\n"));
    Ok(())
}

/// Questions and answers.
pub struct Dialog<R, W> {
    /// Source of answers.
    pub answers: R,
    /// Destination of questions.
    pub questions: W,
    /// Repeat a question after a bad answer, instead of failing with its line.
    pub patient: bool,
    /// Number of lines read.
    pub line: usize,
}

impl<R: BufRead, W: Write> Dialog<R, W> {
    /// Asks for a whole map.
    pub fn map(&mut self, name: &str) -> Result<MapFile> {
        let mut map = MapFile::empty(name);
        self.say(
            "1. Concepts: NAME or NAME: NOTE, one a line, in the order of the matrix; an empty line ends",
        )?;
        self.list(&mut map, concept)?;
        self.say("2. Causes: CAUSE > EFFECT, one a line; an empty line ends")?;
        self.list(&mut map, edge)?;
        self.say(&format!("3. Weights: a number in -1 ..= 1, or {}", terms::list()))?;
        for at in 0..map.edge.len() {
            let EdgeFile { from, to, .. } = &map.edge[at];
            let question = format!("{from} > {to}");
            map.edge[at].weight = self.one(&question, |text| {
                Weight::parse(text)
                    .with_context(|| format!("{text:?} is neither a number in -1 ..= 1 nor a term"))
            })?;
        }
        self.say(
            "4. Threshold: the transfer function of a sum, and its threshold; empty: the value in brackets",
        )?;
        map.transfer =
            self.or("bivalent, trivalent, sigmoid, tanh or positive [tanh]", map.transfer, transfer)?;
        map.threshold = self.or("threshold [0]", map.threshold, |text| Ok(threshold(text)?.to_f64()))?;
        map.lambda = self.or("steepness [1]", map.lambda, lambda)?;
        self.say(
            "Inputs: SOURCE FORM POINTS, such as: press rise 0 30000, host 0 triangle 0 100 200; empty: none",
        )?;
        for entry in map.entries().into_iter().map(String::from).collect::<Vec<_>>() {
            if let Some(own) = self.one(&entry, |text| input(&entry, text))? {
                map.input.push(own);
            }
        }
        BoardMap::build(&map)?;
        Ok(map)
    }

    fn say(&mut self, text: &str) -> Result<()> {
        Ok(writeln!(self.questions, "{text}")?)
    }

    /// Reads lines up to an empty one; `take` adds each to the map or refuses it.
    fn list(&mut self, map: &mut MapFile, take: fn(&mut MapFile, &str) -> Result<()>) -> Result<()> {
        while self.one("", |text| if text.is_empty() { Ok(false) } else { take(map, text).map(|()| true) })? {
        }
        Ok(())
    }

    /// Reads an answer; an empty one selects `usual`.
    fn or<T: Copy>(&mut self, question: &str, usual: T, read: fn(&str) -> Result<T, String>) -> Result<T> {
        self.one(
            question,
            |text| if text.is_empty() { Ok(usual) } else { read(text).map_err(|why| anyhow!(why)) },
        )
    }

    /// Reads one answer.
    fn one<T>(&mut self, question: &str, mut read: impl FnMut(&str) -> Result<T>) -> Result<T> {
        loop {
            write!(self.questions, "{question}> ")?;
            self.questions.flush()?;
            let mut text = String::new();
            self.line += 1;
            if self.answers.read_line(&mut text)? == 0 {
                bail!("line {}: the answers end before the map is complete", self.line);
            }
            match read(text.trim()) {
                Ok(answer) => return Ok(answer),
                Err(why) if self.patient => self.say(&why.to_string())?,
                Err(why) => bail!("line {}: {why}", self.line),
            }
        }
    }
}

fn concept(map: &mut MapFile, text: &str) -> Result<()> {
    let (name, note) =
        text.split_once(':').map_or((text, ""), |(name, note)| (name.trim_end(), note.trim_start()));
    if map.find(name).is_some() {
        bail!("concept {name} is named twice");
    }
    map.concept.push(ConceptFile { name: name.into(), note: note.into(), threshold: None });
    Ok(map.to_config::<1024, 0>().map(drop)?)
}

fn edge(map: &mut MapFile, text: &str) -> Result<()> {
    let (from, to) = text.split_once('>').context("expected CAUSE > EFFECT")?;
    let (from, to) = (from.trim(), to.trim());
    for name in [from, to] {
        map.find(name).with_context(|| format!("{name} is not a concept"))?;
    }
    if map.edge(from, to).is_some() {
        bail!("edge {from} > {to} is given twice");
    }
    let (from, to, weight) = (from.into(), to.into(), Weight::Number(0.0));
    map.edge.push(EdgeFile { from, to, weight, fixed: false, note: String::new() });
    Ok(())
}

fn input(concept: &str, text: &str) -> Result<Option<InputFile>> {
    let mut words = text.split_whitespace();
    let Some(word) = words.next() else { return Ok(None) };
    let source = match word {
        "host" => {
            let slot = words.next().and_then(|slot| slot.parse().ok());
            Source::Host(slot.context("host needs the number of a slot")?)
        }
        _ => serde_json::from_value(word.into()).with_context(|| format!("{word} is not a source"))?,
    };
    let form = words.next().unwrap_or_default();
    let points: Vec<i32> = words
        .map(|word| word.parse().with_context(|| format!("{word} is not a whole number")))
        .collect::<Result<_>>()?;
    let mut input = InputFile { concept: concept.into(), source: Some(source), ..InputFile::default() };
    match (form, &points[..]) {
        ("rise", [a, b]) => input.rise = Some([*a, *b]),
        ("fall", [a, b]) => input.fall = Some([*a, *b]),
        ("triangle", [a, b, c]) => input.triangle = Some([*a, *b, *c]),
        ("trapezoid", [a, b, c, d]) => input.trapezoid = Some([*a, *b, *c, *d]),
        _ => bail!("expected rise A B, fall A B, triangle A B C or trapezoid A B C D"),
    }
    input.inputs(0, 4, 0)?;
    Ok(Some(input))
}
